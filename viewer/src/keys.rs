//! The one table of keys: the dashboard and the window obey it, the help is made of it, and so is
//! the table in the README.

use std::fmt;

/// A key, whether it was pressed on a terminal or in a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Key {
    /// A character as it was typed, with its case.
    Char(char),
    /// A letter with Ctrl.
    Ctrl(char),
    /// The space bar.
    Space,
    /// An arrow.
    Left,
    /// An arrow.
    Right,
    /// An arrow.
    Up,
    /// An arrow.
    Down,
    /// To the beginning.
    Home,
    /// To the end.
    End,
    /// A page back.
    PageUp,
    /// A page on.
    PageDown,
    /// Takes what is chosen or typed.
    Enter,
    /// Closes what is open.
    Escape,
    /// The next field.
    Tab,
    /// The field before.
    BackTab,
    /// Takes the last character away.
    Backspace,
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self {
            Self::Char(c) => return write!(f, "{c}"),
            Self::Ctrl(c) => return write!(f, "Ctrl-{}", c.to_uppercase()),
            Self::Space => "space",
            Self::Left => "←",
            Self::Right => "→",
            Self::Up => "↑",
            Self::Down => "↓",
            Self::Home => "Home",
            Self::End => "End",
            Self::PageUp => "PgUp",
            Self::PageDown => "PgDn",
            Self::Enter => "Enter",
            Self::Escape => "Esc",
            Self::Tab => "Tab",
            Self::BackTab => "Shift-Tab",
            Self::Backspace => "Backspace",
        };
        f.write_str(name)
    }
}

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Action {
    /// Plays or pauses.
    Play,
    /// Turns time round.
    Turn,
    /// One step back along physical time.
    StepBack,
    /// One step on.
    StepOn,
    /// A lower pace.
    Slower,
    /// A higher pace.
    Faster,
    /// To the start.
    ToStart,
    /// To the farthest time reached.
    ToFarthest,
    /// Back by a twentieth of the time bar.
    ScrubBack,
    /// On by a twentieth of it.
    ScrubOn,
    /// Breaks off a seek, closes what is open.
    Cancel,
    /// Flips the last bit of one particle.
    Flip,
    /// Switches to floating point, and back to fixed point.
    Switch,
    /// The next colouring.
    Colour,
    /// The next colour map.
    Colormap,
    /// Dark or light.
    Theme,
    /// Closer.
    ZoomIn,
    /// Farther.
    ZoomOut,
    /// The whole scene.
    ResetView,
    /// The view to the left.
    PanLeft,
    /// The view down.
    PanDown,
    /// The view up.
    PanUp,
    /// The view to the right.
    PanRight,
    /// In 3D, the camera around the scene.
    OrbitLeft,
    /// In 3D, the camera lower.
    OrbitDown,
    /// In 3D, the camera higher.
    OrbitUp,
    /// In 3D, the camera around the scene, the other way.
    OrbitRight,
    /// The same from the start, with nothing done to it.
    Anew,
    /// Other scenes and runs.
    Scenes,
    /// The panel of parameters.
    Parameters,
    /// Keeps the state in a directory.
    Keep,
    /// Writes a picture.
    Picture,
    /// The keys.
    Help,
    /// The other arithmetic beside it, from the start, or without it again.
    Beside,
    /// Leaves.
    Quit,
}

/// Keys that belong together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Binding {
    /// Their heading in the help.
    pub group: &'static str,
    /// Keys and what each does.
    pub keys: &'static [(Key, Action)],
    /// What they do, in a few words.
    pub meaning: &'static str,
}

const fn binding(
    group: &'static str,
    keys: &'static [(Key, Action)],
    meaning: &'static str,
) -> Binding {
    Binding {
        group,
        keys,
        meaning,
    }
}

use Action as A;
use Key as K;

/// All keys.
pub const TABLE: &[Binding] = &[
    binding("time", &[(K::Space, A::Play)], "play, pause"),
    binding(
        "time",
        &[(K::Char('r'), A::Turn)],
        "reverse time: every velocity changes its sign",
    ),
    binding(
        "time",
        &[(K::Left, A::StepBack), (K::Right, A::StepOn)],
        "one step back, one step on",
    ),
    binding(
        "time",
        &[(K::Char('['), A::Slower), (K::Char(']'), A::Faster)],
        "slower, faster",
    ),
    binding(
        "time",
        &[(K::Home, A::ToStart), (K::End, A::ToFarthest)],
        "go to the start, to the farthest time",
    ),
    binding(
        "time",
        &[(K::PageUp, A::ScrubBack), (K::PageDown, A::ScrubOn)],
        "a twentieth of the bar back, on; or click it",
    ),
    binding(
        "time",
        &[(K::Escape, A::Cancel)],
        "stop on the way there; close what is open",
    ),
    binding(
        "experiments",
        &[(K::Char('b'), A::Flip)],
        "flip the last bit of one particle, and mark it",
    ),
    binding(
        "experiments",
        &[(K::Char('f'), A::Switch)],
        "go on in floating point, or in fixed again",
    ),
    binding(
        "experiments",
        &[(K::Char('n'), A::Anew)],
        "begin anew, with nothing done to it",
    ),
    binding(
        "view",
        &[(K::Char('c'), A::Colour)],
        "let the colours say something else",
    ),
    binding("view", &[(K::Char('m'), A::Colormap)], "another colour map"),
    binding("view", &[(K::Char('t'), A::Theme)], "dark, light"),
    binding(
        "view",
        &[
            (K::Char('+'), A::ZoomIn),
            (K::Char('-'), A::ZoomOut),
            (K::Char('0'), A::ResetView),
        ],
        "closer, farther, whole scene; or the wheel",
    ),
    binding(
        "view",
        &[
            (K::Char('h'), A::PanLeft),
            (K::Char('j'), A::PanDown),
            (K::Char('k'), A::PanUp),
            (K::Char('l'), A::PanRight),
        ],
        "move the view; or drag",
    ),
    binding(
        "view",
        &[
            (K::Char('H'), A::OrbitLeft),
            (K::Char('J'), A::OrbitDown),
            (K::Char('K'), A::OrbitUp),
            (K::Char('L'), A::OrbitRight),
        ],
        "in 3D, turn the view; or drag, right button",
    ),
    binding(
        "program",
        &[(K::Char('o'), A::Scenes)],
        "open another scene or run",
    ),
    binding(
        "program",
        &[(K::Char('e'), A::Parameters)],
        "edit the parameters and start anew",
    ),
    binding(
        "program",
        &[(K::Char('s'), A::Keep)],
        "save the state, to be opened again",
    ),
    binding("program", &[(K::Char('p'), A::Picture)], "write a PNG"),
    binding("program", &[(K::Char('?'), A::Help)], "this help"),
    binding(
        "program",
        &[(K::Char('q'), A::Quit), (K::Ctrl('c'), A::Quit)],
        "quit",
    ),
];

/// Keys of the window alone.
pub const WINDOW: &[Binding] = &[binding(
    "experiments",
    &[(K::Char('x'), A::Beside)],
    "from the start, fixed beside floating point",
)];

/// The keys that the window obeys, those of a group together.
#[must_use]
pub fn of_window() -> Vec<Binding> {
    let mut all = TABLE.to_vec();
    for binding in WINDOW {
        let last = all.iter().rposition(|other| other.group == binding.group);
        all.insert(last.map_or(all.len(), |n| n + 1), *binding);
    }
    all
}

/// The first key of a table that does this, for people.
#[must_use]
pub fn key_of(table: &[Binding], action: Action) -> Option<String> {
    let mut pairs = table.iter().flat_map(|binding| binding.keys);
    let found = pairs.find(|(_, does)| *does == action);
    found.map(|(key, _)| key.to_string())
}

/// What a key does in the window.
#[must_use]
pub fn window_action(key: Key) -> Option<Action> {
    let own = WINDOW.iter().flat_map(|binding| binding.keys);
    let own = own.filter(|(k, _)| *k == key).map(|(_, action)| *action);
    own.chain(action(key)).next()
}

/// Keys that do the same as one of the table, for other keyboards and habits.
const ALSO: &[(Key, Action)] = &[
    (K::Char('='), A::ZoomIn),
    (K::Char('_'), A::ZoomOut),
    (K::Char('R'), A::Turn),
    (K::Char('{'), A::Slower),
    (K::Char('}'), A::Faster),
    (K::Char('Q'), A::Quit),
];

/// What a key does.
#[must_use]
pub fn action(key: Key) -> Option<Action> {
    let in_table = TABLE.iter().flat_map(|binding| binding.keys);
    in_table
        .chain(ALSO)
        .find(|(k, _)| *k == key)
        .map(|(_, action)| *action)
}

impl Binding {
    /// Its keys, for people.
    #[must_use]
    pub fn names(&self) -> String {
        let names: Vec<String> = self.keys.iter().map(|(key, _)| key.to_string()).collect();
        names.join(" ")
    }
}

/// The table as Markdown, as the README shows it.
#[must_use]
pub fn markdown() -> String {
    let mut text = String::from("| keys | |\n|---|---|\n");
    for binding in TABLE {
        let keys: Vec<String> = binding
            .keys
            .iter()
            .map(|(key, _)| format!("`{key}`"))
            .collect();
        text += &format!("| {} | {} |\n", keys.join(" "), binding.meaning);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn no_key_does_two_things() {
        let in_table = TABLE.iter().chain(WINDOW).flat_map(|binding| binding.keys);
        let keys: Vec<Key> = in_table.chain(ALSO).map(|(key, _)| *key).collect();
        assert_eq!(keys.iter().collect::<HashSet<_>>().len(), keys.len());
    }

    #[test]
    fn groups_stay_together() {
        for table in [TABLE.to_vec(), of_window()] {
            let mut groups: Vec<&str> = table.iter().map(|binding| binding.group).collect();
            groups.dedup();
            assert_eq!(groups.iter().collect::<HashSet<_>>().len(), groups.len());
        }
    }

    #[test]
    fn the_window_obeys_what_its_help_lists() {
        let listed: Vec<(Key, Action)> = of_window()
            .iter()
            .flat_map(|binding| binding.keys.to_vec())
            .collect();
        for (key, action) in &listed {
            assert_eq!(window_action(*key), Some(*action));
        }
        let mut all = TABLE.iter().chain(WINDOW).flat_map(|binding| binding.keys);
        assert!(all.all(|pair| listed.contains(pair)));
    }
}
