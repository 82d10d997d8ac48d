//! Operators and built-in functions: chapters 5 and 8 of the GLSL 1.20 specification, except textures and derivatives.

use crate::value::{Base, Type, Value};
use std::cmp::Ordering;

/// How the numbers of a float are kept after each operation.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Precision {
    /// In 64 bits.
    #[default]
    Double,
    /// In 32 bits, as drivers keep them. The operations `+ - * /` and `sqrt` are then exactly those of 32 bits.
    Single,
}

impl Precision {
    /// Returns a value as it is kept.
    pub(crate) fn keep(self, value: Value) -> Value {
        if self == Self::Single && value.of.base == Base::Float {
            value.map(|number| self.keep_number(number))
        } else {
            value
        }
    }

    fn keep_number(self, number: f64) -> f64 {
        if self == Self::Single { f64::from(number as f32) } else { number }
    }
}

/// What went wrong, without its line.
type ValueResult = Result<Value, String>;

/// Carries out a unary operator.
pub(crate) fn unary(operator: &str, operand: Value) -> ValueResult {
    match (operator, operand.of.base) {
        ("-", Base::Float | Base::Int) => Ok(operand.map(|number| -number)),
        ("+", Base::Float | Base::Int) => Ok(operand),
        ("!", Base::Bool) if operand.of.is_scalar() => Ok(Value::bool(!operand.is_true())),
        _ => Err(format!("{operator} cannot be used with {}", operand.of)),
    }
}

/// Carries out a binary operator, except those of bools, which may skip their second operand.
pub(crate) fn binary(operator: &str, left: Value, right: Value, precision: Precision) -> ValueResult {
    let refuse = || Err(format!("{operator} cannot be used with {} and {}", left.of, right.of));
    match operator {
        "==" | "!=" => {
            let (left, right) =
                if left.of.is_scalar() { (promoted(left, right.of), promoted(right, left.of)) } else { (left, right) };
            if left.of != right.of {
                return Err(format!("{} cannot be compared with {}", left.of, right.of));
            }
            return Ok(Value::bool((left.numbers() == right.numbers()) == (operator == "==")));
        }
        "<" | ">" | "<=" | ">=" => {
            if !left.of.is_scalar() || !right.of.is_scalar() || left.of.base == Base::Bool {
                return refuse();
            }
            return Ok(Value::bool(compare(operator, left.first(), right.first())));
        }
        _ => {}
    }
    let is_number = |value: &Value| matches!(value.of.base, Base::Float | Base::Int);
    if !is_number(&left) || !is_number(&right) {
        return refuse();
    }
    let is_product = operator == "*" && (left.of.is_matrix() || right.of.is_matrix());
    if is_product && !left.of.is_scalar() && !right.of.is_scalar() {
        return product(left, right, precision).map_or_else(refuse, Ok);
    }
    let is_whole = left.of.base == Base::Int && right.of.base == Base::Int;
    let operate = |a: f64, b: f64| match operator {
        "+" => a + b,
        "-" => a - b,
        "*" => a * b,
        _ if is_whole && b == 0.0 => 0.0,
        _ if is_whole => (a / b).trunc(),
        _ => a / b,
    };
    combined(&[left, right], |numbers| operate(numbers[0], numbers[1]))
        .map(|value| precision.keep(value))
        .map_or_else(refuse, Ok)
}

/// Whether two numbers are in this order.
fn compare(operator: &str, a: f64, b: f64) -> bool {
    match (operator, a.partial_cmp(&b)) {
        ("<" | "lessThan", Some(Ordering::Less)) => true,
        (">" | "greaterThan", Some(Ordering::Greater)) => true,
        ("<=" | "lessThanEqual", Some(Ordering::Less | Ordering::Equal)) => true,
        (">=" | "greaterThanEqual", Some(Ordering::Greater | Ordering::Equal)) => true,
        ("equal", Some(Ordering::Equal)) => true,
        ("notEqual", order) => order != Some(Ordering::Equal),
        _ => false,
    }
}

/// Returns an int as a float where the other value is a float.
pub(crate) fn promoted(value: Value, other: Type) -> Value {
    if value.of.base == Base::Int && other.base == Base::Float { value.as_base(Base::Float) } else { value }
}

/// Combines values number by number; scalars go with each. `None` if their shapes differ.
fn combined(values: &[Value], combine: impl Fn(&[f64]) -> f64) -> Option<Value> {
    let mut of = values.iter().map(|value| value.of).max_by_key(|of| of.count())?;
    of.base = if values.iter().any(|value| value.of.base == Base::Float) { Base::Float } else { values[0].of.base };
    let is_same_shape = |value: &Value| (value.of.columns, value.of.rows) == (of.columns, of.rows);
    if !values.iter().all(|value| value.of.is_scalar() || is_same_shape(value)) {
        return None;
    }
    let mut result = Value::new(of, &[]);
    let mut numbers = [0.0; 3];
    for place in 0..of.count() {
        for (number, value) in numbers.iter_mut().zip(values) {
            *number = if value.of.is_scalar() { value.first() } else { value.numbers()[place] };
        }
        result.numbers_mut()[place] = combine(&numbers[..values.len().min(3)]);
    }
    Some(result)
}

/// The product of linear algebra; `None` if columns and rows do not fit.
fn product(left: Value, right: Value, precision: Precision) -> Option<Value> {
    // A vector on the left is a row.
    let (rows, inner) = if left.of.is_matrix() {
        (usize::from(left.of.rows), usize::from(left.of.columns))
    } else {
        (1, left.of.count())
    };
    let (right_rows, columns) = (usize::from(right.of.rows), usize::from(right.of.columns));
    if inner != right_rows || left.of.base != Base::Float || right.of.base != Base::Float {
        return None;
    }
    let is_vector = rows == 1 || columns == 1;
    let side = rows.max(columns) as u8;
    let of = Type { base: Base::Float, columns: if is_vector { 1 } else { side }, rows: side };
    let mut result = Value::new(of, &[]);
    for column in 0..columns {
        for row in 0..rows {
            let terms = (0..inner).map(|k| left.numbers()[k * rows + row] * right.numbers()[column * inner + k]);
            result.numbers_mut()[column * rows + row] = sum(terms, precision);
        }
    }
    Some(result)
}

/// Adds terms in order.
fn sum(terms: impl Iterator<Item = f64>, precision: Precision) -> f64 {
    terms.fold(0.0, |sum, term| precision.keep_number(sum + precision.keep_number(term)))
}

/// Calls a constructor: `vec4(…)`, `float(…)`, `mat3(…)`.
pub(crate) fn construct(of: Type, arguments: &[Value]) -> ValueResult {
    let given: Vec<f64> = arguments.iter().flat_map(|value| value.numbers().to_vec()).collect();
    let numbers = match (arguments, of) {
        ([one], _) if one.of.is_scalar() && of.is_matrix() => {
            let side = usize::from(of.rows);
            (0..of.count()).map(|place| if place % (side + 1) == 0 { one.first() } else { 0.0 }).collect()
        }
        ([one], _) if one.of.is_scalar() => vec![one.first(); of.count()],
        ([one], _) if one.of.is_matrix() && of.is_matrix() => {
            let side = |of: Type| usize::from(of.rows);
            let at = |column: usize, row: usize| match column.max(row) < side(one.of) {
                true => given[column * side(one.of) + row],
                false => f64::from(u8::from(column == row)),
            };
            (0..of.count()).map(|place| at(place / side(of), place % side(of))).collect()
        }
        _ => given,
    };
    if numbers.len() < of.count() || arguments.is_empty() {
        return Err(format!("{of} takes {} numbers, not {}", of.count(), numbers.len()));
    }
    let value = Value::new(of, &numbers);
    Ok(if of.base == Base::Float { value } else { value.as_base(of.base) })
}

/// A function of numbers, for each component of its arguments in turn.
type OfNumbers = fn(&[f64], Precision) -> f64;

/// The built-in functions that take each component by itself, with the number of their arguments.
const OF_NUMBERS: [(&str, usize, OfNumbers); 29] = [
    ("radians", 1, |n, _| n[0].to_radians()),
    ("degrees", 1, |n, _| n[0].to_degrees()),
    ("sin", 1, |n, _| n[0].sin()),
    ("cos", 1, |n, _| n[0].cos()),
    ("tan", 1, |n, _| n[0].tan()),
    ("asin", 1, |n, _| n[0].asin()),
    ("acos", 1, |n, _| n[0].acos()),
    ("atan", 1, |n, _| n[0].atan()),
    ("atan", 2, |n, _| n[0].atan2(n[1])),
    ("pow", 2, |n, _| n[0].powf(n[1])),
    ("exp", 1, |n, _| n[0].exp()),
    ("log", 1, |n, _| n[0].ln()),
    ("exp2", 1, |n, _| n[0].exp2()),
    ("log2", 1, |n, _| n[0].log2()),
    ("sqrt", 1, |n, _| n[0].sqrt()),
    ("inversesqrt", 1, |n, precision| 1.0 / precision.keep_number(n[0].sqrt())),
    ("abs", 1, |n, _| n[0].abs()),
    ("sign", 1, |n, _| if n[0] == 0.0 { 0.0 } else { n[0].signum() }),
    ("floor", 1, |n, _| n[0].floor()),
    ("ceil", 1, |n, _| n[0].ceil()),
    ("fract", 1, |n, _| n[0] - n[0].floor()),
    ("mod", 2, |n, precision| n[0] - n[1] * precision.keep_number(n[0] / n[1]).floor()),
    ("min", 2, |n, _| if n[1] < n[0] { n[1] } else { n[0] }),
    ("max", 2, |n, _| if n[0] < n[1] { n[1] } else { n[0] }),
    ("clamp", 3, |n, _| n[0].max(n[1]).min(n[2])),
    ("mix", 3, |n, precision| {
        let rest = precision.keep_number(1.0 - n[2]);
        precision.keep_number(n[0] * rest) + precision.keep_number(n[1] * n[2])
    }),
    ("step", 2, |n, _| f64::from(u8::from(n[1] >= n[0]))),
    ("smoothstep", 3, |n, _| {
        let share = ((n[2] - n[0]) / (n[1] - n[0])).clamp(0.0, 1.0);
        share * share * (3.0 - 2.0 * share)
    }),
    ("matrixCompMult", 2, |n, _| n[0] * n[1]),
];

/// Calls a built-in function; `None` if none has this name.
pub(crate) fn call(name: &str, arguments: &[Value], precision: Precision) -> Option<ValueResult> {
    let floats: Vec<Value> = arguments.iter().map(|value| promoted(*value, Type::FLOAT)).collect();
    let wrong = || format!("{name} cannot be called with these arguments");
    let each = |count: usize, function: &dyn Fn(&[f64]) -> f64| {
        if floats.len() == count { combined(&floats, function).ok_or_else(wrong) } else { Err(wrong()) }
    };
    let of_numbers = || OF_NUMBERS.iter().filter(|(known, ..)| *known == name);
    let result = match name {
        "lessThan" | "lessThanEqual" | "greaterThan" | "greaterThanEqual" | "equal" | "notEqual" => {
            each(2, &|n| f64::from(u8::from(compare(name, n[0], n[1])))).map(|value| value.as_base(Base::Bool))
        }
        "any" | "all" | "not" => match floats.as_slice() {
            [value] if value.of.base == Base::Bool => Ok(match name {
                "any" => Value::bool(value.numbers().iter().any(|number| *number != 0.0)),
                "all" => Value::bool(value.numbers().iter().all(|number| *number != 0.0)),
                _ => value.map(|number| 1.0 - number),
            }),
            _ => Err(wrong()),
        },
        // Drivers of the time return 0 everywhere, and so do today's (V. Valente 2007, section 3.1).
        "noise1" => Ok(Value::floats(&[0.0])),
        "noise2" => Ok(Value::floats(&[0.0; 2])),
        "noise3" => Ok(Value::floats(&[0.0; 3])),
        "noise4" => Ok(Value::floats(&[0.0; 4])),
        _ if of_numbers().next().is_some() => of_numbers()
            .find(|(_, count, _)| *count == floats.len())
            .map_or_else(|| Err(wrong()), |(_, count, function)| each(*count, &|n| function(n, precision))),
        _ => geometric(name, &floats, precision)?.ok_or_else(wrong),
    };
    Some(result.map(|value| precision.keep(value)))
}

/// Calls a function of whole vectors or matrices: `None` if none has this name, `Some(None)` if the arguments do not fit.
fn geometric(name: &str, given: &[Value], precision: Precision) -> Option<Option<Value>> {
    let keep = |number: f64| precision.keep_number(number);
    let dot = |a: &Value, b: &Value| sum(a.numbers().iter().zip(b.numbers()).map(|(a, b)| a * b), precision);
    let scaled = |value: &Value, by: f64| value.map(|number| number * by);
    let minus = |a: &Value, b: &Value| combined(&[*a, *b], |n| keep(n[0] - n[1]));
    let are_alike = given.iter().all(|value| value.of == given[0].of);
    Some(match (name, given) {
        ("length", [a]) => Some(Value::floats(&[dot(a, a).sqrt()])),
        ("distance", [a, b]) if are_alike => {
            minus(a, b).map(|between| Value::floats(&[dot(&between, &between).sqrt()]))
        }
        ("dot", [a, b]) if are_alike => Some(Value::floats(&[dot(a, b)])),
        ("cross", [left, right]) if are_alike => match (left.numbers(), right.numbers()) {
            ([a, b, c], [d, e, f]) => {
                let minor = |p: &f64, q: &f64, r: &f64, s: &f64| keep(p * s) - keep(q * r);
                Some(Value::floats(&[minor(b, c, e, f), minor(c, a, f, d), minor(a, b, d, e)]))
            }
            _ => None,
        },
        ("normalize", [a]) => Some(scaled(a, keep(1.0 / keep(dot(a, a).sqrt())))),
        ("faceforward", [n, i, r]) if are_alike => Some(if dot(r, i) < 0.0 { *n } else { scaled(n, -1.0) }),
        ("reflect", [ray, normal]) if are_alike => {
            minus(ray, &precision.keep(scaled(normal, keep(2.0 * dot(normal, ray)))))
        }
        ("refract", [ray, normal, ratio]) if ray.of == normal.of => {
            let (cosine, ratio) = (dot(normal, ray), ratio.first());
            let rest = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
            match rest < 0.0 {
                true => Some(scaled(ray, 0.0)),
                false => minus(&scaled(ray, ratio), &scaled(normal, ratio * cosine + rest.sqrt())),
            }
        }
        ("transpose", [matrix]) => {
            let side = usize::from(matrix.of.columns);
            let mut turned = *matrix;
            for (place, number) in turned.numbers_mut().iter_mut().enumerate() {
                *number = matrix.numbers()[place % side * side + place / side];
            }
            Some(turned)
        }
        (
            "length" | "distance" | "dot" | "cross" | "normalize" | "faceforward" | "reflect" | "refract" | "transpose",
            _,
        ) => None,
        _ => return None,
    })
}
