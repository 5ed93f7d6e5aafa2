//! What a mouse does, whatever face it is on.

/// What the mouse did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mouse {
    /// A button went down.
    Press(Button),
    /// It moved, whatever is held.
    Move,
    /// A button went up.
    Release,
    /// The wheel turned by so many notches, towards the scene where positive.
    Wheel(f64),
}

/// A button of the mouse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Button {
    /// The first.
    Left,
    /// The second.
    Right,
}

/// A drag of the mouse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drag {
    /// On the bar of time, last at this step.
    Bar(i64),
    /// On the particles, last at this place of the face, moving the view.
    Pan([f64; 2]),
    /// On the particles, last at this place of the face, turning the view.
    Orbit([f64; 2]),
}
