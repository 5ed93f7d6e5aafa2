//! Checks what was written against the [schema](super::schema): every key is known, every
//! value has its key's type and range. All mistakes are collected.

use super::error::{MOST_FOUND, Problem, ProblemKind};
use super::model::Model;
use super::nearest::nearest;
use super::region_keys::REGION;
use super::schema::{Family, Form, Range, SceneKey, TableRules, ValueType, listed, quoted};
use super::spec::{Node, SceneSpec, Span, WrittenTable, WrittenValue};
use super::types::TOP;
use super::values::number;
use super::words::Dimension;

/// Every mistake that can be seen in one value alone.
pub(super) fn check(spec: &SceneSpec) -> Vec<Problem> {
    check_as(spec, TOP)
}

/// As [`check`], for a top level with these rules.
pub(super) fn check_as(spec: &SceneSpec, top: &'static TableRules) -> Vec<Problem> {
    let mut checker = Checker {
        spec,
        dimension: dimension(&spec.root),
        family: family(&spec.root),
        problems: Vec::new(),
    };
    checker.table(&spec.root, top);
    checker.problems
}

/// The dimension of a scene; `None` when it is written wrongly.
pub(super) fn dimension(root: &WrittenTable) -> Option<Dimension> {
    match root.get("dimension").map(|entry| &entry.node.value) {
        None | Some(WrittenValue::Integer(2)) => Some(Dimension::Two),
        Some(WrittenValue::Integer(3)) => Some(Dimension::Three),
        Some(_) => None,
    }
}

/// The keys that the model of a scene has; `None` when the model is written wrongly.
pub(super) fn family(root: &WrittenTable) -> Option<Family> {
    let model: Option<Model> = match root.get("model").map(|entry| &entry.node.value) {
        None => Some(Model::Symplectic),
        Some(WrittenValue::Text(word)) => Model::from_word(word),
        Some(_) => None,
    };
    model.map(Model::family)
}

/// The mistake of a key that does not exist.
pub(super) fn unknown_key(
    spec: &SceneSpec,
    rules: &'static TableRules,
    name: &str,
    span: Span,
) -> Problem {
    let dimension = dimension(&spec.root);
    let family = family(&spec.root);
    let here: Vec<&str> = rules
        .keys
        .iter()
        .filter(|key| key.exists_in(dimension) && key.exists_for(family))
        .map(|key| key.name)
        .collect();
    let help = if let Some(meant) = nearest(name, here.iter().copied()) {
        vec![format!("did you mean `{meant}`?")]
    } else if let Some(owner) = TOP.find_below(name) {
        vec![format!("`{name}` is a key of {}", owner.title)]
    } else {
        let all: Vec<String> = here.iter().map(|name| format!("`{name}`")).collect();
        vec![format!(
            "the keys of {} are {}",
            rules.title,
            listed(&all, "and")
        )]
    };
    let message = match rules.form {
        Form::File => format!("unknown key `{name}`"),
        _ => format!("unknown key `{name}` in {}", rules.title),
    };
    spec.problem(ProblemKind::UnknownKey, message, span, help)
}

struct Checker<'a> {
    spec: &'a SceneSpec,
    dimension: Option<Dimension>,
    family: Option<Family>,
    problems: Vec<Problem>,
}

impl Checker<'_> {
    fn report(&mut self, kind: ProblemKind, message: String, span: Span, help: Vec<String>) {
        if self.problems.len() >= MOST_FOUND {
            return;
        }
        self.problems
            .push(self.spec.problem(kind, message, span, help));
    }

    fn table(&mut self, table: &WrittenTable, rules: &'static TableRules) {
        for entry in &table.entries {
            if self.problems.len() >= MOST_FOUND {
                return;
            }
            let Some(key) = rules.key(&entry.name) else {
                self.problems
                    .push(unknown_key(self.spec, rules, &entry.name, entry.key));
                continue;
            };
            if let (Some(only), Some(dimension)) = (key.only, self.dimension)
                && only != dimension
            {
                self.wrong_dimension(rules, key, dimension, entry.key);
                continue;
            }
            if let (Some(owner), Some(family)) = (key.family, self.family)
                && owner != family
            {
                self.wrong_model(key, owner, entry.key);
                continue;
            }
            self.value(key, &entry.node);
        }
    }

    fn wrong_model(&mut self, key: &SceneKey, owner: Family, span: Span) {
        let models = quoted(&Model::words_of(owner), "or");
        let message = format!("`{}` is a key of another model", key.name);
        let help = vec![format!("remove it, or set `model` to {models}")];
        self.report(ProblemKind::Conflict, message, span, help);
    }

    fn wrong_dimension(
        &mut self,
        rules: &'static TableRules,
        key: &SceneKey,
        dimension: Dimension,
        span: Span,
    ) {
        let message = format!(
            "`{}` does not exist in {} dimensions",
            key.name,
            dimension.axes()
        );
        let twin = rules
            .keys
            .iter()
            .find(|other| other.kind == key.kind && other.only == Some(dimension))
            // Shapes of one kind stand for each other; numbers of one kind do not.
            .filter(|twin| twin.kind.is_table());
        let help = match twin {
            Some(twin) => format!(
                "in {} dimensions write `{}`: {}",
                dimension.axes(),
                twin.name,
                twin.meaning
            ),
            None => format!("it needs `dimension = {}`", 5 - dimension.axes()),
        };
        self.report(ProblemKind::Conflict, message, span, vec![help]);
    }

    fn value(&mut self, key: &SceneKey, node: &Node) {
        match (key.kind, &node.value) {
            (ValueType::Text, WrittenValue::Text(_)) => {}
            (ValueType::Flag, WrittenValue::Boolean(_)) => {}
            (ValueType::Choice(words), WrittenValue::Text(word)) => {
                self.choice(key, words, word, node.span)
            }
            (ValueType::Model(_), WrittenValue::Text(word)) => {
                self.choice(key, &Model::known(), word, node.span)
            }
            (ValueType::Dimension, WrittenValue::Integer(2 | 3)) => {}
            (ValueType::Dimension, WrittenValue::Integer(n)) => {
                let message = format!("`dimension` is {n}");
                let help = vec!["allowed: 2 or 3".to_owned()];
                self.report(ProblemKind::OutOfRange, message, node.span, help);
            }
            (ValueType::Number, WrittenValue::Integer(_) | WrittenValue::Float(_)) => {
                self.number(key, node)
            }
            (ValueType::Whole, WrittenValue::Integer(_)) => self.number(key, node),
            (ValueType::Vector, WrittenValue::List(list)) => self.vector(key, list, node.span),
            (ValueType::Rotation, _) => self.rotation(key, node),
            (ValueType::Matrix, WrittenValue::List(rows)) => self.matrix(key, rows, node.span),
            (ValueType::Corners, WrittenValue::List(points)) => self.points(key, points, node.span),
            (ValueType::Table(rules), WrittenValue::Table(table)) => self.table(table, rules),
            (ValueType::Tables(rules), WrittenValue::List(list)) => {
                for element in list {
                    if self.problems.len() >= MOST_FOUND {
                        return;
                    }
                    match &element.value {
                        WrittenValue::Table(table) => self.table(table, rules),
                        _ => self.wrong_type(key, element, "a table", Vec::new()),
                    }
                }
            }
            _ => {
                let (expected, help) = self.expectation(key, node);
                self.wrong_type(key, node, &expected, help);
            }
        }
    }

    fn wrong_type(&mut self, key: &SceneKey, node: &Node, expected: &str, help: Vec<String>) {
        let message = format!(
            "`{}`: expected {expected}, found {}",
            key.name,
            node.value.type_name()
        );
        self.report(ProblemKind::WrongType, message, node.span, help);
    }

    /// What a key wants, and what to tell someone who wrote something else.
    fn expectation(&self, key: &SceneKey, node: &Node) -> (String, Vec<String>) {
        let axes = self.dimension.map_or(2, Dimension::axes);
        match key.kind {
            ValueType::Text => ("a string".to_owned(), Vec::new()),
            ValueType::Choice(words) => (
                "a word in quotation marks".to_owned(),
                vec![format!("allowed: {}", quoted(words, "or"))],
            ),
            ValueType::Model(_) => (
                "a word in quotation marks".to_owned(),
                vec![format!("allowed: {}", quoted(&Model::known(), "or"))],
            ),
            ValueType::Flag => ("true or false".to_owned(), Vec::new()),
            ValueType::Dimension => ("2 or 3".to_owned(), Vec::new()),
            ValueType::Whole => (in_unit("a whole number", key), allowed(key)),
            ValueType::Number | ValueType::Rotation => (in_unit("a number", key), allowed(key)),
            ValueType::Vector => (
                in_unit(&format!("{axes} numbers"), key),
                vec![format!("write `{} = [{}]`", key.name, example(axes))],
            ),
            ValueType::Matrix => (
                in_unit(&format!("{axes} rows of {axes} numbers"), key),
                Vec::new(),
            ),
            ValueType::Corners => (in_unit("a list of points", key), Vec::new()),
            ValueType::Table(inner) => ("a table".to_owned(), self.table_help(node, inner)),
            ValueType::Tables(inner) if *inner == REGION => (
                "an array of tables".to_owned(),
                vec!["write `[[region]]` in double brackets, once for each region".to_owned()],
            ),
            ValueType::Tables(_) => (
                "an array of shapes".to_owned(),
                vec![format!("write `{} = [{{ … }}, {{ … }}]`", key.name)],
            ),
        }
    }

    /// What to tell someone who wrote something else than a table.
    fn table_help(&self, node: &Node, inner: &TableRules) -> Vec<String> {
        if inner.form == Form::Header && matches!(node.value, WrittenValue::List(_)) {
            return vec![format!("write {} in single brackets", inner.title)];
        }
        let names: Vec<String> = inner
            .keys
            .iter()
            .filter(|key| key.exists_in(self.dimension) && key.exists_for(self.family))
            .map(|key| format!("`{}`", key.name))
            .collect();
        vec![format!("its keys are {}", listed(&names, "and"))]
    }

    fn choice(&mut self, key: &SceneKey, words: &[&str], word: &str, span: Span) {
        if words.contains(&word) {
            return;
        }
        let mut help = Vec::new();
        if let Some(meant) = nearest(word, words.iter().copied()) {
            help.push(format!("did you mean \"{meant}\"?"));
        }
        help.push(format!("allowed: {}", quoted(words, "or")));
        let message = format!("`{}` cannot be \"{word}\"", key.name);
        self.report(ProblemKind::OutOfRange, message, span, help);
    }

    /// Checks one number of a key, alone or inside a vector.
    fn number(&mut self, key: &SceneKey, node: &Node) {
        let Some(x) = number(node) else {
            let expected = in_unit("a number", key);
            return self.wrong_type(key, node, &expected, allowed(key));
        };
        if x.is_finite() && key.range.contains(x) {
            return;
        }
        let message = if x.is_finite() {
            let unit = if key.unit.is_empty() {
                String::new()
            } else {
                format!(" {}", key.unit)
            };
            format!("`{}` is out of range: {x:?}{unit}", key.name)
        } else {
            format!("`{}` must be a finite number", key.name)
        };
        self.report(ProblemKind::OutOfRange, message, node.span, allowed(key));
    }

    fn vector(&mut self, key: &SceneKey, list: &[Node], span: Span) {
        if let Some(dimension) = self.dimension
            && list.len() != dimension.axes()
        {
            self.length(key, "numbers", dimension.axes(), list.len(), span);
        }
        for element in list {
            self.number(key, element);
        }
    }

    fn length(&mut self, key: &SceneKey, what: &str, expected: usize, found: usize, span: Span) {
        let message = format!("`{}`: expected {expected} {what}, found {found}", key.name);
        let help = vec![format!("the scene has `dimension = {expected}`")];
        self.report(ProblemKind::WrongType, message, span, help);
    }

    fn rotation(&mut self, key: &SceneKey, node: &Node) {
        match (self.dimension, &node.value) {
            (Some(Dimension::Three) | None, WrittenValue::List(list)) => {
                self.vector(key, list, node.span);
            }
            (Some(Dimension::Three), _) => {
                let expected = in_unit("3 numbers", key);
                let help = vec![format!(
                    "write the axis and the speed: `{} = [0.0, 0.0, 1.0]`",
                    key.name
                )];
                self.wrong_type(key, node, &expected, help);
            }
            _ => self.number(key, node),
        }
    }

    fn matrix(&mut self, key: &SceneKey, rows: &[Node], span: Span) {
        if let Some(dimension) = self.dimension
            && rows.len() != dimension.axes()
        {
            self.length(key, "rows", dimension.axes(), rows.len(), span);
        }
        for row in rows {
            match &row.value {
                WrittenValue::List(numbers) => self.vector(key, numbers, row.span),
                _ => self.wrong_type(key, row, "a row of numbers", Vec::new()),
            }
        }
    }

    fn points(&mut self, key: &SceneKey, points: &[Node], span: Span) {
        if points.len() < 3 {
            let message = format!(
                "`{}`: expected at least 3 points, found {}",
                key.name,
                points.len()
            );
            self.report(ProblemKind::WrongType, message, span, Vec::new());
        }
        for point in points {
            match &point.value {
                WrittenValue::List(numbers) => self.vector(key, numbers, point.span),
                _ => self.wrong_type(key, point, "a point [x, y]", Vec::new()),
            }
        }
    }
}

fn in_unit(what: &str, key: &SceneKey) -> String {
    if key.unit.is_empty() {
        what.to_owned()
    } else {
        format!("{what} in {}", key.unit)
    }
}

fn example(axes: usize) -> &'static str {
    if axes == 2 {
        "0.0, 1.0"
    } else {
        "0.0, 1.0, 0.0"
    }
}

/// The range and unit of a key, as help.
fn allowed(key: &SceneKey) -> Vec<String> {
    let range = match key.range {
        Range::Any => in_unit("any finite number", key),
        range if key.unit.is_empty() => range.to_string(),
        range => format!("{range} {}", key.unit),
    };
    vec![format!("allowed: {range}")]
}
