//! How points are drawn: camera, colours, theme, and what the panel says.

use crate::camera::View;
use crate::colour::{Colormap, Palette, Theme};
use crate::colouring::Colouring;

/// How points are drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// The camera.
    pub view: View,
    /// What the colours say.
    pub colouring: Colouring,
    /// The map from numbers to colours; `None` for the one that suits the colouring.
    pub colormap: Option<Colormap>,
    /// The numbers at its ends; `None` for [`Colouring::range`].
    pub range: Option<[f64; 2]>,
    /// Colours of everything else.
    pub theme: Theme,
    /// Radius of a disc, in radii of a disc (in 3D a ball) of the particle's volume.
    pub disc: f64,
    /// Title of the panel; `None` for the name of the scene.
    pub title: Option<String>,
    /// A line under the title.
    pub caption: String,
    /// How far the arrow of time has turned, 0 forward to 1 backward; `None` takes it from the
    /// points.
    pub turn: Option<f64>,
    /// Whether there is a panel.
    pub panel: bool,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            view: View::default(),
            colouring: Colouring::default(),
            colormap: None,
            range: None,
            theme: Theme::default(),
            disc: 1.2,
            title: None,
            caption: String::new(),
            turn: None,
            panel: true,
        }
    }
}

impl Look {
    /// The colour map at work.
    #[must_use]
    pub fn colormap(&self) -> Colormap {
        self.colormap.unwrap_or_else(|| self.colouring.colormap())
    }

    /// The part of it that can be told from the ground.
    #[must_use]
    pub fn palette(&self) -> Palette {
        self.colormap().over(self.theme.background)
    }
}
