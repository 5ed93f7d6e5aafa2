//! The words of the scene language: each closed choice is an enum, and each enum
//! lists its words once, so that parsing, help texts and printing cannot disagree.

/// A choice written in a scene as one word.
pub(super) trait ChoiceWord: Sized + Copy + 'static {
    /// Every word of this choice.
    const WORDS: &'static [&'static str];

    /// Stands in for a word that was refused and has no default.
    const FIRST: Self;

    /// The value a word stands for, or `None` when the word is not one of this choice.
    fn from_word(word: &str) -> Option<Self>;

    /// The word a scene uses for this value.
    fn word(self) -> &'static str;
}

/// Declares a choice: an enum whose variants stand beside their words.
macro_rules! words {
    (
        $(#[$doc:meta])*
        $name:ident { $($(#[$variant_doc:meta])* $variant:ident = $word:literal,)+ }
    ) => {
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

        impl $crate::scene::words::ChoiceWord for $name {
            const WORDS: &'static [&'static str] = $name::WORDS;
            const FIRST: Self = [$(Self::$variant),+][0];

            fn from_word(word: &str) -> Option<Self> {
                match word { $($word => Some(Self::$variant),)+ _ => None }
            }

            fn word(self) -> &'static str {
                $name::word(self)
            }
        }
    };
}
pub(super) use words;

words! {
    /// What is done about regions that overlap.
    Overlap {
        /// Refused, with the place of the first particle.
        Refuse = "refuse",
        /// Each region is filled as if the others were not there.
        Allow = "allow",
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
    /// What a region is filled with.
    RegionKind {
        /// Particles that move.
        Fluid = "fluid",
        /// Particles that stay where they are.
        Wall = "wall",
        /// Particles of an elastic body.
        Solid = "solid",
    }
}

impl RegionKind {
    /// Whether its particles belong to those that a model moves.
    #[must_use]
    pub const fn is_of_the_model(self) -> bool {
        matches!(self, Self::Fluid | Self::Solid)
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
