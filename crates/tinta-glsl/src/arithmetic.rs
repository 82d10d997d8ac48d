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
            value.map(|number| f64::from(number as f32))
        } else {
            value
        }
    }
}

/// What went wrong, without its line.
type Computed = Result<Value, String>;

/// Carries out a unary operator.
pub(crate) fn unary(operator: &str, operand: Value) -> Computed {
    match (operator, operand.of.base) {
        ("-", Base::Float | Base::Int) => Ok(operand.map(|number| -number)),
        ("+", Base::Float | Base::Int) => Ok(operand),
        ("!", Base::Bool) if operand.of.is_scalar() => Ok(Value::bool(!operand.is_true())),
        _ => Err(format!("{operator} cannot be used with {}", operand.of)),
    }
}

/// Carries out a binary operator, except those of bools, which may skip their second operand.
pub(crate) fn binary(operator: &str, left: Value, right: Value, precision: Precision) -> Computed {
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
    let keep = |number: f64| if precision == Precision::Single { f64::from(number as f32) } else { number };
    terms.fold(0.0, |sum, term| keep(sum + keep(term)))
}

/// Calls a constructor: `vec4(…)`, `float(…)`, `mat3(…)`.
pub(crate) fn construct(of: Type, arguments: &[Value]) -> Computed {
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

/// Calls a built-in function; `None` if none has this name.
pub(crate) fn call(name: &str, arguments: &[Value], precision: Precision) -> Option<Computed> {
    let floats: Vec<Value> = arguments.iter().map(|value| promoted(*value, Type::FLOAT)).collect();
    let wrong = || format!("{name} cannot be called with these arguments");
    let each = |count: usize, function: &dyn Fn(&[f64]) -> f64| {
        if floats.len() == count { combined(&floats, function).ok_or_else(wrong) } else { Err(wrong()) }
    };
    let keep = |number: f64| precision.keep(Value::floats(&[number])).first();
    let dot = |a: &Value, b: &Value| sum(a.numbers().iter().zip(b.numbers()).map(|(a, b)| a * b), precision);
    let scaled = |value: &Value, by: f64| value.map(|number| number * by);
    let minus = |a: &Value, b: &Value| combined(&[*a, *b], |n| keep(n[0] - n[1])).ok_or_else(wrong);
    let vectors = |count: usize| match floats.as_slice() {
        given if given.len() == count && given.iter().all(|value| value.of == given[0].of) => Ok(given),
        _ => Err(wrong()),
    };
    let result = match name {
        "radians" => each(1, &|n| n[0].to_radians()),
        "degrees" => each(1, &|n| n[0].to_degrees()),
        "sin" => each(1, &|n| n[0].sin()),
        "cos" => each(1, &|n| n[0].cos()),
        "tan" => each(1, &|n| n[0].tan()),
        "asin" => each(1, &|n| n[0].asin()),
        "acos" => each(1, &|n| n[0].acos()),
        "atan" if floats.len() == 2 => each(2, &|n| n[0].atan2(n[1])),
        "atan" => each(1, &|n| n[0].atan()),
        "pow" => each(2, &|n| n[0].powf(n[1])),
        "exp" => each(1, &|n| n[0].exp()),
        "log" => each(1, &|n| n[0].ln()),
        "exp2" => each(1, &|n| n[0].exp2()),
        "log2" => each(1, &|n| n[0].log2()),
        "sqrt" => each(1, &|n| n[0].sqrt()),
        "inversesqrt" => each(1, &|n| 1.0 / keep(n[0].sqrt())),
        "abs" => each(1, &|n| n[0].abs()),
        "sign" => each(1, &|n| if n[0] == 0.0 { 0.0 } else { n[0].signum() }),
        "floor" => each(1, &|n| n[0].floor()),
        "ceil" => each(1, &|n| n[0].ceil()),
        "fract" => each(1, &|n| n[0] - n[0].floor()),
        "mod" => each(2, &|n| n[0] - n[1] * keep(n[0] / n[1]).floor()),
        "min" => each(2, &|n| if n[1] < n[0] { n[1] } else { n[0] }),
        "max" => each(2, &|n| if n[0] < n[1] { n[1] } else { n[0] }),
        "clamp" => each(3, &|n| n[0].max(n[1]).min(n[2])),
        "mix" => each(3, &|n| keep(n[0] * keep(1.0 - n[2])) + keep(n[1] * n[2])),
        "step" => each(2, &|n| f64::from(u8::from(n[1] >= n[0]))),
        "smoothstep" => each(3, &|n| {
            let share = ((n[2] - n[0]) / (n[1] - n[0])).clamp(0.0, 1.0);
            share * share * (3.0 - 2.0 * share)
        }),
        "length" => vectors(1).map(|given| Value::floats(&[dot(&given[0], &given[0]).sqrt()])),
        "distance" => vectors(2).and_then(|given| {
            let between = minus(&given[0], &given[1])?;
            Ok(Value::floats(&[dot(&between, &between).sqrt()]))
        }),
        "dot" => vectors(2).map(|given| Value::floats(&[dot(&given[0], &given[1])])),
        "cross" => vectors(2).and_then(|given| match (given[0].numbers(), given[1].numbers()) {
            ([a, b, c], [d, e, f]) => {
                let minor = |p: &f64, q: &f64, r: &f64, s: &f64| keep(p * s) - keep(q * r);
                Ok(Value::floats(&[minor(b, c, e, f), minor(c, a, f, d), minor(a, b, d, e)]))
            }
            _ => Err(wrong()),
        }),
        "normalize" => vectors(1).map(|given| {
            let length = keep(dot(&given[0], &given[0]).sqrt());
            scaled(&given[0], keep(1.0 / length))
        }),
        "faceforward" => vectors(3).map(|n| if dot(&n[2], &n[1]) < 0.0 { n[0] } else { scaled(&n[0], -1.0) }),
        "reflect" => vectors(2).and_then(|given| {
            let twice = keep(2.0 * dot(&given[1], &given[0]));
            minus(&given[0], &precision.keep(scaled(&given[1], twice)))
        }),
        "refract" => match floats.as_slice() {
            [ray, normal, ratio] if ray.of == normal.of => {
                let (cosine, ratio) = (dot(normal, ray), ratio.first());
                let rest = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
                if rest < 0.0 {
                    Ok(scaled(ray, 0.0))
                } else {
                    minus(&scaled(ray, ratio), &scaled(normal, ratio * cosine + rest.sqrt()))
                }
            }
            _ => Err(wrong()),
        },
        "matrixCompMult" => each(2, &|n| n[0] * n[1]),
        "transpose" => vectors(1).map(|given| {
            let side = usize::from(given[0].of.columns);
            let mut turned = given[0];
            for (place, number) in turned.numbers_mut().iter_mut().enumerate() {
                *number = given[0].numbers()[place % side * side + place / side];
            }
            turned
        }),
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
        _ => return None,
    };
    Some(result.map(|value| precision.keep(value)))
}
