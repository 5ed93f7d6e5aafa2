//! The scenes that come with the program, each citing its source.

/// A scene of the catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CatalogueEntry {
    /// The name by which it is run.
    pub name: &'static str,
    /// One line for a list.
    pub title: &'static str,
    /// Where its numbers come from.
    pub citation: &'static str,
    /// The scene file.
    pub text: &'static str,
}

/// Every scene that comes with the program.
#[must_use]
pub fn catalogue() -> &'static [CatalogueEntry] {
    ENTRIES
}

pub(super) fn entry(name: &str) -> Option<&'static CatalogueEntry> {
    ENTRIES.iter().find(|entry| entry.name == name)
}

const ENTRIES: &[CatalogueEntry] = &[
    CatalogueEntry {
        name: "dam-break",
        title: "a column of water collapses in an open box, and time is turned at 1 s",
        citation: "Kincl & Pavelka, Comput. Phys. Commun. 284 (2023) 108593, Table 1",
        text: include_str!("../../scenes/dam-break.toml"),
    },
    CatalogueEntry {
        name: "dam-break-3d",
        title: "the dam break in three dimensions, about 16,000 particles",
        citation: "after Kincl & Pavelka, Comput. Phys. Commun. 284 (2023) 108593, Table 1",
        text: include_str!("../../scenes/dam-break-3d.toml"),
    },
    CatalogueEntry {
        name: "colliding-drops",
        title: "two drops collide off-centre, without gravity or walls",
        citation: "after Monaghan, J. Comput. Phys. 110 (1994) 399-406",
        text: include_str!("../../scenes/colliding-drops.toml"),
    },
    CatalogueEntry {
        name: "rotating-drop",
        title: "a free drop in rigid rotation opens into a wheel of threads",
        citation: "after Colagrossi, PhD thesis, Università di Roma La Sapienza (2005)",
        text: include_str!("../../scenes/rotating-drop.toml"),
    },
    CatalogueEntry {
        name: "gresho-vortex",
        title: "a vortex that should stand still, in a box of dummy particles",
        citation: "Kincl & Pavelka, Comput. Phys. Commun. 284 (2023) 108593, Table 3",
        text: include_str!("../../scenes/gresho-vortex.toml"),
    },
    CatalogueEntry {
        name: "kepler-ring",
        title: "a ring of fluid around a mass turns ten times, and back",
        citation: "after footnote 8 of Kincl & Pavelka, Comput. Phys. Commun. 284 (2023) 108593",
        text: include_str!("../../scenes/kepler-ring.toml"),
    },
];
