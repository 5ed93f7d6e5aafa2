//! The models of this package: a line each.
//!
//! A line names the model, its word in scenes, the family whose keys it reads, what makes it from
//! the parameters of a scene, the function of [`crate::setup`] that gives those, and what it does
//! not go with. The scene language
//! ([`crate::scene::Model`]) and the set-up ([`crate::setup::simulation`]) are both made of this
//! list. A model of somebody else's package is registered when the program starts:
//! [`crate::own::register`].

/// Hands the list to a macro.
macro_rules! for_each_model {
    ($take:ident) => {
        $take! {
            /// Density by summation over the neighbours: Hamiltonian and reversible.
            Symplectic = "symplectic", keys wcsph, made by Symplectic::new, from parameters,
                except [];
            /// Density advanced in time by the continuity equation: not reversible.
            Standard = "standard", keys wcsph, made by Standard::new, from parameters,
                except [Exclusion {
                key: "integrator",
                unless: Some("stormer-verlet"),
                help: "the standard scheme has a kick, a drift and a kick of its own: \
write `integrator = \"stormer-verlet\"`, or `model = \"symplectic\"`",
            }];
            /// The symplectic scheme with its noise filtered out every few steps: dissipative.
            Filtered = "filtered", keys wcsph, made by Filter::filtered, from parameters,
                except [Exclusion {
                key: "turnaround",
                unless: None,
                help: "the filter takes noise and energy out of the flow, and nothing brings them \
back: write `end`, or `model = \"symplectic\"`",
            }];
            /// Elastic bodies, reversible.
            Solid = "solid", keys solid, made by Solid::new, from solid_parameters,
                except [Exclusion {
                key: "integrator",
                unless: Some("stormer-verlet"),
                help: "a solid has one composition of kicks, lifts and a drift: write \
`integrator = \"stormer-verlet\"`, or remove the key",
            }];
            /// Elastic bodies with the integrator of the paper: not reversible to the last bit.
            SolidMidpoint = "solid-midpoint", keys solid, made by Midpoint::new,
                from solid_parameters, except [Exclusion {
                key: "integrator",
                unless: Some("stormer-verlet"),
                help: "the midpoint scheme has a composition of its own: write \
`integrator = \"stormer-verlet\"`, or remove the key",
            }];
            /// A viscous fluid with the equations of solids, whose distortion relaxes: dissipative.
            Viscous = "viscous", keys viscous, made by Relaxing::viscous, from fluid_parameters,
                except [
                Exclusion {
                    key: "turnaround",
                    unless: None,
                    help: "viscosity takes energy and information out of the flow, and nothing \
brings them back: write `end`",
                },
                Exclusion {
                    key: "integrator",
                    unless: Some("stormer-verlet"),
                    help: "the viscous model has a composition of its own: write \
`integrator = \"stormer-verlet\"`, or remove the key",
                },
            ];
            /// Superfluid helium, reversible.
            Superfluid = "superfluid", keys superfluid, made by Superfluid::new,
                from helium_parameters, except [Exclusion {
                key: "integrator",
                unless: Some("stormer-verlet"),
                help: "superfluid helium has one composition of kicks, lifts and a drift: write \
`integrator = \"stormer-verlet\"`, or remove the key",
            }];
            /// Superfluid helium whose normal component has friction, and which conducts heat:
            /// dissipative.
            SuperfluidDissipative = "superfluid-dissipative", keys superfluid,
                made by Friction::superfluid, from helium_parameters, except [
                Exclusion {
                    key: "turnaround",
                    unless: None,
                    help: "friction takes energy and information out of the flow, and nothing \
brings them back: write `end`, or `model = \"superfluid\"`",
                },
                Exclusion {
                    key: "integrator",
                    unless: Some("stormer-verlet"),
                    help: "superfluid helium has one composition of kicks, lifts and a drift: \
write `integrator = \"stormer-verlet\"`, or remove the key",
                },
            ];
            /// Superfluid helium with the integrator of the paper: not reversible.
            SuperfluidPaper = "superfluid-paper", keys superfluid, made by PaperSuperfluid::new,
                from helium_parameters, except [Exclusion {
                key: "integrator",
                unless: Some("stormer-verlet"),
                help: "the paper's scheme has a composition of its own: write \
`integrator = \"stormer-verlet\"`, or remove the key",
            }];
        }
    };
}
pub(crate) use for_each_model;
