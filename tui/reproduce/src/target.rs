//! What can be reproduced.

use crate::lab::{Lab, LabError};
use crate::section::Section;
use crate::targets;
use std::time::Instant;

macro_rules! targets {
    ($($(#[$doc:meta])* $variant:ident = $name:literal, $title:literal, $function:path;)+) => {
        /// A figure, a table or a claim.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Target { $($(#[$doc])* $variant,)+ }

        impl Target {
            /// All of them, in the order of the report.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];

            /// Its name on the command line.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)+ }
            }

            /// What it is, in a line.
            #[must_use]
            pub fn title(self) -> &'static str {
                match self { $(Self::$variant => $title,)+ }
            }

            fn work(self, lab: &mut Lab<'_>) -> Result<Section, LabError> {
                match self { $(Self::$variant => $function(lab),)+ }
            }
        }
    };
}

targets! {
    /// Fig. 1.
    Fig1 = "fig1", "initial state correction", targets::correction::fig1;
    /// Fig. 2.
    Fig2 = "fig2", "energy of the standard and of the symplectic scheme", targets::dam::fig2;
    /// Fig. 3.
    Fig3 = "fig3", "fixed and floating point, out and back", targets::dam::fig3;
    /// Fig. 4.
    Fig4 = "fig4", "the leading edge against experiment and simulation", targets::edge::fig4;
    /// Fig. 5 and Figs. 8 to 12.
    Fig5 = "fig5", "the energy budget there and back (with Figs. 8 to 12)", targets::dam::fig5;
    /// Fig. 6.
    Fig6 = "fig6", "the speeds at 2 s and the entropy out and back", targets::entropy::fig6;
    /// Fig. 7 and Table 2.
    Table2 = "table2", "the Gresho vortex on four lattices, unfiltered and filtered (with Fig. 7)",
        targets::gresho::table2;
    /// Footnote 8.
    Kepler = "kepler", "the Kepler ring, ten revolutions and back", targets::claims::kepler;
    /// What the paper says and does not show.
    Claims = "claims", "voids, dummy walls, the time step, three dimensions",
        targets::claims::claims;
    /// Beyond the paper.
    Echo = "echo", "fidelity of the echo and the Lyapunov exponent", targets::echo::echo;
    /// Beyond the paper.
    Work = "work", "work and precision of every integrator, and the preset `accurate`",
        targets::work::work;
    /// Figs. 2 to 4 of the paper on solids.
    Plate = "plate", "solids: the beryllium plate (Figs. 2 to 4 of the second paper)",
        targets::plate::plate;
    /// Figs. 5 to 7 of the paper on solids.
    Column = "column", "solids: the twisting column (Figs. 5 to 7 of the second paper)",
        targets::column::column;
    /// A thin body against the beam formula.
    Cantilever = "cantilever", "solids: a cantilever against the beam formula",
        targets::beam::cantilever;
    /// Figs. 8 to 10 of the paper on solids.
    Couette = "couette", "viscous: Taylor-Couette flow (Figs. 8 to 10 of the second paper)",
        targets::couette::couette;
    /// Figs. 11 to 14 of the paper on solids.
    Cavity = "cavity", "viscous: the lid-driven cavity (Figs. 11 to 14 of the second paper)",
        targets::cavity::cavity;
    /// Figs. 1 to 4 of the paper on superfluid helium.
    NormalCavity = "normal-cavity",
        "helium: the lid-driven cavity (Figs. 1 to 4 of the third paper)",
        targets::normal_cavity::normal_cavity;
    /// Figs. 5 and 6 of the paper on superfluid helium.
    Sound = "second-sound", "helium: second sound (Figs. 5 and 6 of the third paper)",
        targets::sound::sound;
    /// Figs. 8 to 12 of the paper on superfluid helium.
    Fountain = "fountain", "helium: the fountain (Figs. 8 to 12 of the third paper)",
        targets::fountain::fountain;
}

/// Names for several targets at once.
pub const GROUPS: [(&str, &str, &[Target]); 2] = [
    (
        "solids",
        "the second paper: plate, column, cantilever, couette and cavity",
        &[
            Target::Plate,
            Target::Column,
            Target::Cantilever,
            Target::Couette,
            Target::Cavity,
        ],
    ),
    (
        "helium",
        "the third paper: normal-cavity, second-sound and fountain",
        &[Target::NormalCavity, Target::Sound, Target::Fountain],
    ),
];

impl Target {
    /// The target of this name.
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL
            .iter()
            .copied()
            .find(|target| target.name() == name)
    }

    /// Works it out, or takes it from an earlier report in the same directory.
    ///
    /// # Errors
    /// A signal came, or something that had to work did not.
    pub fn reproduce(self, lab: &mut Lab<'_>) -> Result<Section, LabError> {
        if let Some(section) = lab.kept(self.name()) {
            lab.say(&format!("{}: kept from before", self.name()));
            return Ok(section);
        }
        lab.say(&format!("{}: {}", self.name(), self.title()));
        let began = Instant::now();
        let mut section = self.work(lab)?;
        section.target = self.name().to_owned();
        section.seconds = began.elapsed().as_secs_f64();
        lab.keep(&section)?;
        Ok(section)
    }
}
