//! Styles, from the theme that field, pictures and window have in common.

use super::super::state::{DashboardState, Depth};
use loschmidt_runner::Arrow;
use loschmidt_viewer::{Rgb, Theme};
use ratatui::style::{Color, Modifier, Style};

/// A colour of the terminal.
pub fn colour(rgb: Rgb) -> Color {
    let [r, g, b] = rgb.channels();
    Color::Rgb(r, g, b)
}

/// Styles.
#[derive(Clone, Copy, Debug)]
pub struct Ink {
    pub theme: Theme,
    pub depth: Depth,
    arrow: Arrow,
}

impl Ink {
    pub fn of(state: &DashboardState) -> Self {
        let stage = state.session.stage.as_ref();
        Self {
            theme: state.session.look.theme,
            depth: state.depth,
            arrow: stage.map_or(Arrow::Forward, |stage| stage.arrow()),
        }
    }

    /// The ground of the page.
    pub fn page(&self) -> Style {
        Style::new()
            .bg(colour(self.theme.background))
            .fg(colour(self.theme.text))
    }

    /// A text of this colour.
    pub fn of_colour(&self, rgb: Rgb) -> Style {
        Style::new().fg(colour(rgb))
    }

    pub fn text(&self) -> Style {
        self.of_colour(self.theme.text)
    }

    pub fn bold(&self) -> Style {
        self.text().add_modifier(Modifier::BOLD)
    }

    pub fn faint(&self) -> Style {
        self.of_colour(self.theme.faint)
    }

    pub fn rule(&self) -> Style {
        self.of_colour(self.theme.rule)
    }

    /// The colour of the direction of time.
    pub fn time_colour(&self) -> Rgb {
        match self.arrow {
            Arrow::Forward => self.theme.forward,
            Arrow::Backward => self.theme.backward,
        }
    }

    /// What belongs to time.
    pub fn time(&self) -> Style {
        self.of_colour(self.time_colour())
    }

    /// What went wrong.
    pub fn alarm(&self) -> Style {
        self.of_colour(self.alarm_colour())
            .add_modifier(Modifier::BOLD)
    }

    pub fn alarm_colour(&self) -> Rgb {
        if self.theme == Theme::LIGHT {
            Rgb(0xb4_1f_2f)
        } else {
            Rgb(0xff_6b_6b)
        }
    }

    /// What went well.
    pub fn success_colour(&self) -> Rgb {
        self.theme.second
    }

    /// A colour that stands back behind the same one in full.
    pub fn muted(&self, rgb: Rgb) -> Rgb {
        rgb.mix(self.theme.background, 140)
    }

    /// Text on a coloured ground.
    pub fn badge(&self, ground: Rgb) -> Style {
        let style = Style::new()
            .bg(colour(ground))
            .fg(colour(self.theme.background))
            .add_modifier(Modifier::BOLD);
        if self.depth == Depth::None {
            style.add_modifier(Modifier::REVERSED)
        } else {
            style
        }
    }

    /// The ground of what lies over the rest.
    pub fn sheet(&self) -> Style {
        Style::new()
            .bg(colour(self.theme.panel))
            .fg(colour(self.theme.text))
    }
}
