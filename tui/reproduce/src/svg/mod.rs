//! Figures as SVG: charts with axes, and pictures of particles.
//!
//! Everything is text of a few kilobytes that any browser shows and any diff compares. Colours are
//! those of Okabe & Ito, which the colour-blind can tell apart; fields are in viridis. Labels may
//! hold subscripts: `C_a`, one letter, an underscore and what is set lower.

mod axis;
mod chart;
mod field;
mod legend;
mod marks;
pub mod text;

pub use chart::Chart;
pub use field::{Field, fields};
pub use marks::{COLOURS, Series, Style, line, styled};

/// The beginning of a document of this class and size, pixels.
fn open(class: &str, width: f64, height: f64) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"{class}\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" height=\"{height:.0}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\">\n<rect width=\"{width:.0}\" height=\"{height:.0}\" fill=\"white\"/>\n"
    )
}

/// Whether a document is a chart, of which two stand side by side on a page.
#[must_use]
pub fn is_chart(svg: &str) -> bool {
    svg.lines()
        .next()
        .is_some_and(|first| first.contains("class=\"chart\""))
}
