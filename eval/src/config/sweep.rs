//! Sweeps: one table of a comparison that stands for many.
//!
//! Wherever a value may stand, `{ sweep = [0.2, 0.5, 1.0] }` stands for each of its values in turn, several
//! sweeps for every combination, the later one in the file varying fastest.

use env_model::FileError;
use env_model::source::Source;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// More would be a slip of the pen.
const MOST: usize = 1000;

/// A value without sweeps, and what tells it from its siblings: `velocity_limit=0.5`.
pub(super) type Variant<'i> = (Vec<String>, Spanned<DeValue<'i>>);

/// All that `value` stands for; `path` is its key, dotted where it is nested.
pub(super) fn expand<'i>(
    source: &Source<'_>,
    path: &str,
    value: Spanned<DeValue<'i>>,
) -> Result<Vec<Variant<'i>>, FileError> {
    let span = value.span();
    let too_many = |n: usize| source.error_at(span.clone(), format!("{n} variants; expected at most {MOST}"));
    let variants = match value.into_inner() {
        DeValue::Table(mut table) if table.contains_key("sweep") => {
            let sweep = table.remove("sweep").expect("just found");
            if let Some((other, _)) = table.iter().next() {
                let message = format!("{} beside sweep; expected {{ sweep = [0.2, 0.5] }} alone", other.get_ref());
                return Err(source.error_at(other.span(), message));
            }
            let (at, values) = (sweep.span(), sweep.into_inner());
            let values = match values {
                DeValue::Array(values) if !values.is_empty() => values,
                _ => return Err(source.error_at(at, "expected an array of one value or more: { sweep = [0.2, 0.5] }")),
            };
            values.into_iter().map(|value| (vec![format!("{path}={}", shown(value.get_ref()))], value)).collect()
        }
        DeValue::Table(table) => {
            let mut entries: Vec<_> = table.into_iter().collect();
            // The map is sorted by key; the file's order is the reader's.
            entries.sort_by_key(|(key, _)| key.span().start);
            let mut all: Vec<(Vec<String>, DeTable<'i>)> = vec![(Vec::new(), DeTable::new())];
            for (key, value) in entries {
                let inner =
                    if path.is_empty() { key.get_ref().to_string() } else { format!("{path}.{}", key.get_ref()) };
                let variants = expand(source, &inner, value)?;
                all = product(&all, &variants, |table, value| {
                    table.insert(key.clone(), value.clone());
                });
                if all.len() > MOST {
                    return Err(too_many(all.len()));
                }
            }
            all.into_iter().map(|(names, table)| (names, Spanned::new(span.clone(), DeValue::Table(table)))).collect()
        }
        DeValue::Array(values) => {
            let mut all: Vec<(Vec<String>, Vec<Spanned<DeValue<'i>>>)> = vec![(Vec::new(), Vec::new())];
            for value in values {
                all = product(&all, &expand(source, path, value)?, |array, value| array.push(value.clone()));
                if all.len() > MOST {
                    return Err(too_many(all.len()));
                }
            }
            let array = |values: Vec<_>| DeValue::Array(values.into_iter().collect());
            all.into_iter().map(|(names, values)| (names, Spanned::new(span.clone(), array(values)))).collect()
        }
        other => vec![(Vec::new(), Spanned::new(span.clone(), other))],
    };
    if variants.len() > MOST { Err(too_many(variants.len())) } else { Ok(variants) }
}

/// Every element of `all` with every one of `variants` added.
fn product<'i, T: Clone>(
    all: &[(Vec<String>, T)],
    variants: &[Variant<'i>],
    add: impl Fn(&mut T, &Spanned<DeValue<'i>>),
) -> Vec<(Vec<String>, T)> {
    let pairs = all.iter().flat_map(|one| variants.iter().map(move |variant| (one, variant)));
    pairs
        .map(|((names, so_far), (more, value))| {
            let mut so_far = so_far.clone();
            add(&mut so_far, value);
            ([names.as_slice(), more].concat(), so_far)
        })
        .collect()
}

/// A value as labels show it: texts without quotes.
fn shown(value: &DeValue<'_>) -> String {
    let joined = |parts: Vec<String>| parts.join(" ");
    match value {
        DeValue::String(text) => text.to_string(),
        DeValue::Integer(number) => number.to_string(),
        DeValue::Float(number) => number.to_string(),
        DeValue::Boolean(truth) => truth.to_string(),
        DeValue::Datetime(time) => time.to_string(),
        DeValue::Array(values) => joined(values.iter().map(|v| shown(v.get_ref())).collect()),
        DeValue::Table(table) => {
            joined(table.iter().map(|(k, v)| format!("{}:{}", k.get_ref(), shown(v.get_ref()))).collect())
        }
    }
}
