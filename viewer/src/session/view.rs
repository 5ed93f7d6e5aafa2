//! How the scene is looked at: camera, colours and theme.

use super::state::Session;
use crate::camera::{Projection, View};
use crate::colour::{Colormap, Theme};
use crate::colouring::Colouring;
use crate::home::Home;
use crate::keys::Action;

/// Radians that a key turns the view by.
const ANGLE: f64 = 0.12;

impl Session {
    /// Moves the view by so many pixels to the right and down.
    pub fn drag_view(&mut self, pixels: [f64; 2]) {
        if let Some(projection) = self.projection() {
            self.look.view = self.look.view.dragged(pixels, &projection);
        }
    }

    /// Turns the view, radians.
    pub fn orbit_view(&mut self, yaw: f64, pitch: f64) {
        self.look.view = self.look.view.orbited(yaw, pitch);
    }

    /// Zooms; what is at this place of the field, pixels from its top left, stays there.
    pub fn zoom_view(&mut self, factor: f64, [x, y]: [f64; 2]) {
        let Some(projection) = self.projection() else {
            return;
        };
        let (width, height) = self.field;
        let from_centre = [x - 0.5 * width as f64, y - 0.5 * height as f64];
        let away = from_centre.map(|d| d * (1.0 - factor) / factor);
        // Dragging is in pixels of the projection before the zoom.
        self.look.view = self.look.view.dragged(away, &projection).zoomed(factor);
    }

    fn projection(&self) -> Option<Projection> {
        let home = &self.stage.as_ref()?.home;
        let (width, height) = self.field;
        Some(Projection::new(home, &self.look.view, width, height))
    }

    /// Moves the view by a tenth of the field to the right and up.
    fn pan(&mut self, [right, up]: [f64; 2]) {
        let (width, height) = (self.field.0 as f64, self.field.1 as f64);
        self.drag_view([-right * 0.1 * width, up * 0.1 * height]);
    }

    /// Does what only changes how the scene is looked at; whether the action was such a one.
    pub(super) fn look_otherwise(&mut self, action: Action) -> bool {
        let look = &mut self.look;
        match action {
            Action::Colour => {
                let stage = self.stage.as_ref();
                let tint = stage.and_then(|stage| stage.tint.clone());
                let home = stage.map(|stage| &stage.home);
                look.colouring =
                    next_colouring(&look.colouring, tint.map(Colouring::Picture), home);
            }
            Action::Colormap => look.colormap = next_colormap(look.colormap),
            Action::Theme => {
                look.theme = if look.theme == Theme::DARK {
                    Theme::LIGHT
                } else {
                    Theme::DARK
                }
            }
            Action::ZoomIn => look.view = look.view.zoomed(1.25),
            Action::ZoomOut => look.view = look.view.zoomed(0.8),
            Action::ResetView => {
                look.view = View::default();
                if let Some(stage) = &mut self.stage {
                    stage.follow();
                }
            }
            Action::PanLeft => self.pan([-1.0, 0.0]),
            Action::PanRight => self.pan([1.0, 0.0]),
            Action::PanDown => self.pan([0.0, -1.0]),
            Action::PanUp => self.pan([0.0, 1.0]),
            Action::OrbitLeft => self.orbit_view(-ANGLE, 0.0),
            Action::OrbitRight => self.orbit_view(ANGLE, 0.0),
            Action::OrbitDown => self.orbit_view(0.0, -ANGLE),
            Action::OrbitUp => self.orbit_view(0.0, ANGLE),
            _ => return false,
        }
        true
    }
}

/// The colouring after this one; that of a picture comes last, where there is one.
fn next_colouring(now: &Colouring, tint: Option<Colouring>, home: Option<&Home>) -> Colouring {
    let columns = home.map_or(&[][..], |home| &home.columns);
    let all = Colouring::choices(columns.iter().map(|(measure, _)| *measure));
    match (all.iter().position(|c| c == now), tint) {
        (Some(place), Some(tint)) if place + 1 == all.len() => tint,
        (Some(place), _) => all[(place + 1) % all.len()].clone(),
        (None, _) => all[0].clone(),
    }
}

/// The colour map after this one: all of them in turn, and then the one that suits the colouring.
fn next_colormap(now: Option<Colormap>) -> Option<Colormap> {
    let all = Colormap::ALL;
    match now {
        None => Some(all[0]),
        Some(map) => {
            let place = all.iter().position(|m| *m == map).unwrap_or(0);
            all.get(place + 1).copied()
        }
    }
}
