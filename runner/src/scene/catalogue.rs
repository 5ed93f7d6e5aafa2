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
    CatalogueEntry {
        name: "beryllium-plate",
        title: "a free plate of beryllium rings, and is un-rung after one period",
        citation: "Kincl et al., Appl. Math. Comput. 439 (2023) 127579, section 4.1",
        text: include_str!("../../scenes/beryllium-plate.toml"),
    },
    CatalogueEntry {
        name: "twisting-column",
        title: "a rubber column on a fixed foot twists by a whole turn, and untwists",
        citation: "Kincl et al., Appl. Math. Comput. 439 (2023) 127579, section 4.2",
        text: include_str!("../../scenes/twisting-column.toml"),
    },
    CatalogueEntry {
        name: "colliding-rings",
        title: "two rubber rings collide off their axis, bounce and ring",
        citation: "after Gray, Monaghan & Swift, Comput. Methods Appl. Mech. Eng. 190 (2001) 6641",
        text: include_str!("../../scenes/colliding-rings.toml"),
    },
    CatalogueEntry {
        name: "cantilever",
        title: "a clamped rubber beam is let go and swings about its static deflection",
        citation: "Euler-Bernoulli beam; material of Turek & Hron, LNCSE 53 (2006) 371",
        text: include_str!("../../scenes/cantilever.toml"),
    },
    CatalogueEntry {
        name: "taylor-couette",
        title: "a viscous fluid between two cylinders, of which the outer one turns",
        citation: "Kincl et al., Appl. Math. Comput. 439 (2023) 127579, section 4.3",
        text: include_str!("../../scenes/taylor-couette.toml"),
    },
    CatalogueEntry {
        name: "lid-driven-cavity",
        title: "a box of viscous fluid under a sliding lid, at a Reynolds number of 100",
        citation: "Kincl et al., Appl. Math. Comput. 439 (2023) 127579, section 4.4",
        text: include_str!("../../scenes/lid-driven-cavity.toml"),
    },
    CatalogueEntry {
        name: "second-sound",
        title: "a standing wave of second sound in superfluid helium, and back",
        citation: "Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124, section III B",
        text: include_str!("../../scenes/second-sound.toml"),
    },
    CatalogueEntry {
        name: "second-sound-steep",
        title: "a strong wave of second sound dissolves into disorder, and gathers itself again",
        citation: "after Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124",
        text: include_str!("../../scenes/second-sound-steep.toml"),
    },
    CatalogueEntry {
        name: "counterflow",
        title: "the two components of helium stream through each other in eddies, and back",
        citation: "no publication: a test of how long a superfluid can be followed",
        text: include_str!("../../scenes/counterflow.toml"),
    },
    CatalogueEntry {
        name: "normal-cavity",
        title: "the normal component of helium alone, in a box under a sliding lid",
        citation: "Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124, section III A",
        text: include_str!("../../scenes/normal-cavity.toml"),
    },
    CatalogueEntry {
        name: "fountain",
        title: "a heater under the surface drives a jet of superfluid helium out of a nozzle",
        citation: "after Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124, section III C",
        text: include_str!("../../scenes/fountain.toml"),
    },
];
