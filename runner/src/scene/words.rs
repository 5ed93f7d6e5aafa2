//! The words of the scene language: each closed choice is an enum, and each enum
//! lists its words once, so that parsing, help texts and printing cannot disagree.

/// A choice written in a scene as one word.
pub(super) trait Word: Sized + Copy + 'static {
    /// The value a word stands for, or `None` when the word is not one of this choice.
    fn from_word(word: &str) -> Option<Self>;
}

macro_rules! words {
    ($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident = $word:literal,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $name { $($(#[$variant_doc])* $variant,)+ }

        impl $name {
            /// Every word of this choice, as a scene spells it.
            pub const WORDS: &'static [&'static str] = &[$($word),+];

            /// The word a scene uses for this value.
            #[must_use]
            pub const fn word(self) -> &'static str {
                match self { $(Self::$variant => $word,)+ }
            }
        }

        impl Word for $name {
            fn from_word(word: &str) -> Option<Self> {
                match word { $($word => Some(Self::$variant),)+ _ => None }
            }
        }
    };
}

words! {
    /// Which discretisation advances the fluid.
    Model {
        /// Density by summation over the neighbours: Hamiltonian and reversible.
        Symplectic = "symplectic",
        /// Density advanced in time by the continuity equation: not reversible.
        Standard = "standard",
        /// The symplectic scheme with its noise filtered out every few steps: dissipative.
        Filtered = "filtered",
    }
}

words! {
    /// Which row of the table of integrators composes drifts and kicks.
    Integrator {
        /// Störmer–Verlet: second order, one force evaluation a step.
        StormerVerlet = "stormer-verlet",
        /// Omelyan, Mryglod and Folk's PEFRL: fourth order, four evaluations.
        Pefrl = "pefrl",
        /// Suzuki's five-fold composition: fourth order, five evaluations.
        Suzuki = "suzuki",
    }
}

words! {
    /// How the summed density is corrected at free surfaces.
    DensityCorrection {
        /// A constant C_a per particle makes the first density the reference density.
        Constant = "constant",
        /// The particles are moved until the bare sum is the reference density (see
        /// [`isc`](crate::isc)).
        Isc = "isc",
        /// The bare sum over the neighbours.
        None = "none",
    }
}

words! {
    /// How walls act on the fluid.
    WallModel {
        /// A repulsive pair potential of each wall particle, part of the energy.
        Conservative = "conservative",
        /// Wall particles take part in density and pressure as fixed fluid.
        Dummy = "dummy",
        /// Walls are left out: no wall particle is made.
        None = "none",
    }
}

words! {
    /// Pressure as a function of density.
    EquationOfState {
        /// p = c² rho0 / 7 ((rho / rho0)^7 - 1).
        Tait = "tait",
        /// p = c² (rho - rho0).
        Linear = "linear",
    }
}

words! {
    /// What a region is filled with.
    RegionKind {
        /// Particles that move.
        Fluid = "fluid",
        /// Particles that stay where they are.
        Wall = "wall",
    }
}

words! {
    /// The regular arrangement of the particles of a region.
    LatticeKind {
        /// Squares of one particle spacing (2D).
        Square = "square",
        /// Rows shifted by half a pitch, one particle per square of the spacing (2D).
        Hexagonal = "hexagonal",
        /// Vogel's spiral around the middle of the region, a sunflower (2D).
        Vogel = "vogel",
        /// Cubes of one particle spacing (3D).
        Cubic = "cubic",
        /// Cubes of two particles each, at corners and middles (3D).
        BodyCentred = "body-centred",
    }
}

impl LatticeKind {
    /// The lattice of a region that does not name one.
    #[must_use]
    pub const fn natural(dimension: Dimension) -> Self {
        match dimension {
            Dimension::Two => Self::Square,
            Dimension::Three => Self::Cubic,
        }
    }

    /// Whether this lattice exists in `dimension`.
    #[must_use]
    pub const fn fits(self, dimension: Dimension) -> bool {
        matches!(
            (self, dimension),
            (Self::Square | Self::Hexagonal | Self::Vogel, Dimension::Two)
                | (Self::Cubic | Self::BodyCentred, Dimension::Three)
        )
    }
}

/// The number of space dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Dimension {
    /// The plane; every z is 0.
    Two,
    /// Space.
    Three,
}

impl Dimension {
    /// The number of axes, 2 or 3.
    #[must_use]
    pub const fn axes(self) -> usize {
        match self {
            Self::Two => 2,
            Self::Three => 3,
        }
    }
}
