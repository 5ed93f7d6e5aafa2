//! The themes by name, for command lines.

use crate::colour::Theme;
use clap::ValueEnum;

/// Names of the themes.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum ThemeName {
    /// Light on dark
    Dark,
    /// Dark on light
    Light,
}

impl From<ThemeName> for Theme {
    fn from(name: ThemeName) -> Self {
        match name {
            ThemeName::Dark => Self::DARK,
            ThemeName::Light => Self::LIGHT,
        }
    }
}
