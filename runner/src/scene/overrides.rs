//! `--set path=value`: changes of single keys, merged into a scene before it is checked.
//!
//! The path is dotted; an element of an array is `region.0` or `region[0]`. The value is
//! TOML; a bare word that is not TOML is a string, so `model=standard` needs no quotation
//! marks, and an empty value removes the key. The parsed text is padded so that positions
//! in it are positions in the override as it was typed.

use toml_edit::Document;

use super::check::unknown_key;
use super::error::{Problem, ProblemKind};
use super::schema::ValueType;
use super::spec::{self, Entry, Node, SceneSpec, Span, WrittenTable, WrittenValue};
use super::types::TOP;

/// The most steps of a path, far beyond any that leads somewhere: the depth of tables
/// stays bounded whatever is typed.
const DEEPEST: usize = 64;

/// One step of a path.
struct Segment<'a> {
    name: &'a str,
    span: Span,
}

/// Merges one override into the scene.
///
/// # Errors
///
/// The one mistake that kept the override from being merged; whether the value suits its
/// key is checked with the rest of the scene.
pub(super) fn apply(spec: &mut SceneSpec, text: &str) -> Result<(), Box<Problem>> {
    let number = spec.add_override(text);
    let whole = Span {
        text: number,
        start: 0,
        end: text.len(),
    };
    let fault = |spec: &SceneSpec, message: String, span: Span, help: &str| {
        let help = vec![help.to_owned()];
        Err(Box::new(spec.problem(
            ProblemKind::Override,
            message,
            span,
            help,
        )))
    };
    let Some(equals) = text.find('=') else {
        let help = "write `path=value`, for instance `--set fluid.sound_speed=60`";
        return fault(
            spec,
            "an override needs an equals sign".to_owned(),
            whole,
            help,
        );
    };
    let path = match segments(&text[..equals], number) {
        Ok(path) => path,
        Err(span) => {
            let help = "a path is keys joined by dots, such as `region.0.shape.circle.radius`";
            return fault(spec, "this is not a path".to_owned(), span, help);
        }
    };
    let value = parse_value(spec, text, equals, number)?;
    let outcome = change(&mut spec.root, &path, value);
    match outcome {
        Ok(Change::Made) => Ok(()),
        Ok(Change::NothingToRemove) => check_path(spec, &path),
        Err((message, span, help)) => fault(spec, message, span, &help),
    }
}

/// Splits a path; the error is the place where it is broken.
fn segments(path: &str, text: usize) -> Result<Vec<Segment<'_>>, Span> {
    if path.split(['.', '[']).count() > DEEPEST {
        return Err(Span {
            text,
            start: 0,
            end: path.len(),
        });
    }
    let mut segments = Vec::new();
    let mut start = 0;
    for part in path.split('.') {
        let mut offset = start;
        for (index, piece) in part.split('[').enumerate() {
            let name = match (index, piece.strip_suffix(']')) {
                (0, None) => piece,
                (1.., Some(inner)) => inner,
                _ => "",
            };
            let leading = name.len() - name.trim_start().len();
            let span = Span {
                text,
                start: offset + leading,
                end: offset + name.trim_end().len().max(leading),
            };
            let name = name.trim();
            if name.is_empty() || name.contains(['[', ']']) {
                return Err(Span {
                    text,
                    start: start.min(path.len()),
                    end: start + part.len(),
                });
            }
            segments.push(Segment { name, span });
            offset += piece.len() + 1;
        }
        start += part.len() + 1;
    }
    Ok(segments)
}

/// The value after the equals sign; `None` when it is empty.
fn parse_value(
    spec: &SceneSpec,
    text: &str,
    equals: usize,
    number: usize,
) -> Result<Option<Node>, Box<Problem>> {
    let written = &text[equals + 1..];
    if written.trim().is_empty() {
        return Ok(None);
    }
    let span = Span {
        text: number,
        start: equals + 1 + (written.len() - written.trim_start().len()),
        end: equals + 1 + written.trim_end().len(),
    };
    // A key and spaces in place of the path: the same bytes, hence the same positions.
    let padded = format!("v{:width$}={written}", "", width = equals.saturating_sub(1));
    match Document::parse(padded.as_str()) {
        Ok(document) => {
            let mut table = spec::table(document.as_table(), number);
            match (table.entries.pop(), table.entries.is_empty()) {
                (Some(entry), true) => Ok(Some(entry.node)),
                _ => Err(Box::new(spec.problem(
                    ProblemKind::Syntax,
                    "an override sets one key".to_owned(),
                    span,
                    vec!["give every key its own `--set`".to_owned()],
                ))),
            }
        }
        Err(_) if !written.trim_start().starts_with(['[', '{', '"', '\'']) => Ok(Some(Node {
            value: WrittenValue::Text(written.trim().to_owned()),
            span,
        })),
        Err(error) => Err(Box::new(spec.syntax_problem(number, &error))),
    }
}

enum Change {
    Made,
    NothingToRemove,
}

/// Why a path leads nowhere: message, place, help.
type Dead = (String, Span, String);

/// Sets or removes what `path` names.
fn change(table: &mut WrittenTable, path: &[Segment], value: Option<Node>) -> Result<Change, Dead> {
    let Some((first, rest)) = path.split_first() else {
        return Ok(Change::NothingToRemove);
    };
    if !rest.is_empty() {
        if table.get(first.name).is_none() {
            if value.is_none() {
                return Ok(Change::NothingToRemove);
            }
            table.entries.push(Entry {
                name: first.name.to_owned(),
                key: first.span,
                node: Node {
                    value: WrittenValue::Table(WrittenTable::default()),
                    span: first.span,
                },
            });
        }
        return match table.get_mut(first.name) {
            Some(entry) => change_inside(&mut entry.node, first, rest, value),
            None => Ok(Change::NothingToRemove),
        };
    }
    let before = table.entries.len();
    match value {
        Some(node) => {
            let new = Entry {
                name: first.name.to_owned(),
                key: first.span,
                node,
            };
            match table.get_mut(first.name) {
                Some(entry) => *entry = new,
                None => table.entries.push(new),
            }
            Ok(Change::Made)
        }
        None => {
            table.entries.retain(|entry| entry.name != first.name);
            if table.entries.len() < before {
                Ok(Change::Made)
            } else {
                Ok(Change::NothingToRemove)
            }
        }
    }
}

fn change_inside(
    node: &mut Node,
    owner: &Segment,
    path: &[Segment],
    value: Option<Node>,
) -> Result<Change, Dead> {
    match &mut node.value {
        WrittenValue::Table(table) => change(table, path, value),
        WrittenValue::List(list) => {
            let Some((first, rest)) = path.split_first() else {
                return Ok(Change::NothingToRemove);
            };
            let count = list.len();
            let place = first
                .name
                .parse()
                .ok()
                .filter(|&index: &usize| index < count);
            let Some(index) = place else {
                let help = match count {
                    0 => format!("`{}` is empty", owner.name),
                    1 => format!("`{}` has 1 element, number 0", owner.name),
                    _ => format!("`{}` has {count} elements, 0 to {}", owner.name, count - 1),
                };
                let message = format!("`{}` has no element `{}`", owner.name, first.name);
                return Err((message, first.span, help));
            };
            match (rest.is_empty(), value) {
                (false, value) => change_inside(&mut list[index], first, rest, value),
                (true, Some(new)) => {
                    list[index] = new;
                    Ok(Change::Made)
                }
                (true, None) => {
                    list.remove(index);
                    Ok(Change::Made)
                }
            }
        }
        other => Err((
            format!("`{}` is {}, it has no parts", owner.name, other.type_name()),
            path.first().map_or(owner.span, |segment| segment.span),
            format!("set it whole: `--set …{}=value`", owner.name),
        )),
    }
}

/// A removal of nothing is right only when the key exists in the language.
fn check_path(spec: &SceneSpec, path: &[Segment]) -> Result<(), Box<Problem>> {
    let mut rules = TOP;
    let mut in_list = false;
    for segment in path {
        if in_list && segment.name.parse::<usize>().is_ok() {
            in_list = false;
            continue;
        }
        match rules.key(segment.name).map(|key| key.kind) {
            Some(ValueType::Table(inner)) => rules = inner,
            Some(ValueType::Tables(inner)) => {
                rules = inner;
                in_list = true;
            }
            Some(_) => return Ok(()),
            None => {
                return Err(Box::new(unknown_key(
                    spec,
                    rules,
                    segment.name,
                    segment.span,
                )));
            }
        }
    }
    Ok(())
}
