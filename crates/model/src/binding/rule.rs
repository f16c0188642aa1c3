//! How a number, direction, rotation or function of a model follows from parameters.

use crate::across;
use flexura_expression::{Formula, Function};
use flexura_spatial::{Quaternion, UnitQuaternion, Vector3, exp};

/// What stands in the place of a value: formulas whose slots are the model's parameters, by their positions.
#[derive(Clone, Debug, PartialEq)]
pub enum Rule {
    /// A number, SI.
    Number(Formula),
    /// A number divided by a constant.
    Quotient(Formula, f64),
    /// G = E/(2 (1 + ν)).
    ShearModulus {
        /// E.
        young: Formula,
        /// ν, above -1 and at most 0.5.
        poisson: Formula,
    },
    /// 1/r with r > 0.
    Reciprocal(Formula),
    /// The factor of a coordinate in a relation: left less right side where it is one and the others are zero, less the same where
    /// all are zero. See [`crate::Coupling`].
    Factor {
        /// Both sides where the coordinate is one.
        with: [Formula; 2],
        /// Both sides where it is zero.
        without: [Formula; 2],
    },
    /// The constant of a relation, right less left side where all coordinates are zero.
    Offset([Formula; 2]),
    /// A unit vector along these components.
    Direction([Formula; 3]),
    /// A unit vector at right angles to an axis: nearest to `near`, or [`across`] where that is not given.
    Across {
        /// The axis, not necessarily of unit length.
        axis: [Formula; 3],
        /// What it is nearest to.
        near: Option<[Formula; 3]>,
    },
    /// A turn by an angle (rad) about an axis.
    Turn {
        /// The axis, not necessarily of unit length.
        axis: [Formula; 3],
        /// The angle.
        angle: Formula,
    },
    /// Rz(yaw) Ry(pitch) Rx(roll).
    RollPitchYaw([Formula; 3]),
    /// w, x, y, z, of unit length but for rounding.
    Quaternion([Formula; 4]),
    /// A function of its own variable, with parameters in its slots.
    Function(Function),
}

/// What a rule gives.
pub(super) enum Value {
    Number(f64),
    Vector(Vector3<f64>),
    Rotation(UnitQuaternion<f64>),
    Function(Function),
}

/// Why a rule gives nothing.
pub(super) type Wrong = (String, &'static str);

impl Rule {
    /// The value with these values of the parameters.
    pub(super) fn value(&self, slots: &[f64]) -> Result<Value, Wrong> {
        let vector = |formulas: &[Formula; 3]| Vector3::from(formulas.each_ref().map(|f| f.evaluate(slots)));
        Ok(match self {
            Rule::Number(formula) => Value::Number(number(formula.evaluate(slots))?),
            Rule::Quotient(formula, by) => Value::Number(number(formula.evaluate(slots) / by)?),
            Rule::Factor { with, without } => {
                let [one, zero] = [with, without].map(|[l, r]| l.evaluate(slots) - r.evaluate(slots));
                Value::Number(number(one - zero)?)
            }
            Rule::Offset([left, right]) => {
                Value::Number(number(0.0 - (left.evaluate(slots) - right.evaluate(slots)))?)
            }
            Rule::ShearModulus { young, poisson } => {
                let poisson = poisson.evaluate(slots);
                if poisson <= -1.0 || poisson > 0.5 {
                    let message =
                        format!("Poisson's ratio must lie above -1 and at most at 0.5, is {poisson}");
                    return Err((message, "most metals have about 0.3"));
                }
                Value::Number(number(young.evaluate(slots) / (2.0 * (1.0 + poisson)))?)
            }
            Rule::Reciprocal(formula) => {
                let radius = formula.evaluate(slots);
                if radius <= 0.0 {
                    let hint = "to bend the other way, turn the tube by `rotation = \"180 deg\"`";
                    return Err((format!("must be positive, is {radius}"), hint));
                }
                Value::Number(number(1.0 / radius)?)
            }
            Rule::Direction(formulas) => Value::Vector(unit(vector(formulas))?),
            Rule::Across { axis, near } => {
                let axis = unit(vector(axis))?;
                let Some(near) = near else { return Ok(Value::Vector(across(&axis))) };
                let near = unit(vector(near))?;
                let cosine = axis.dot(&near);
                if cosine.abs() > ALMOST_RIGHT {
                    let angle = cosine.clamp(-1.0, 1.0).acos().to_degrees();
                    let message =
                        format!("must be at right angles to `axis`, but the angle is {angle:.1} deg");
                    return Err((message, "let both axes follow the same parameter"));
                }
                Value::Vector((near - axis * cosine).normalize())
            }
            Rule::Turn { axis, angle } => {
                Value::Rotation(exp(&(unit(vector(axis))? * number(angle.evaluate(slots))?)))
            }
            Rule::RollPitchYaw(formulas) => {
                let rpy = vector(formulas);
                number(rpy.sum())?;
                Value::Rotation(roll_pitch_yaw(&rpy))
            }
            Rule::Quaternion(formulas) => {
                let [w, x, y, z] = formulas.each_ref().map(|f| f.evaluate(slots));
                let quaternion = Quaternion::new(w, x, y, z);
                let norm = quaternion.norm();
                if norm.is_nan() || (norm - 1.0).abs() > ROUNDED {
                    let message = format!("a quaternion must have length 1, this one has {norm}");
                    return Err((message, "the order is w, x, y, z; no turn is [1, 0, 0, 0]"));
                }
                Value::Rotation(UnitQuaternion::from_quaternion(quaternion))
            }
            Rule::Function(function) => Value::Function(function.bound(slots)),
        })
    }

    /// The parameters on which it hangs, each as often as it stands there.
    pub fn parameters(&self) -> impl Iterator<Item = usize> + '_ {
        let formulas: Vec<&Formula> = match self {
            Rule::Number(f) | Rule::Quotient(f, _) | Rule::Reciprocal(f) => vec![f],
            Rule::ShearModulus { young, poisson } => vec![young, poisson],
            Rule::Factor { with, without } => with.iter().chain(without).collect(),
            Rule::Offset(both) => both.iter().collect(),
            Rule::Direction(list) | Rule::RollPitchYaw(list) => list.iter().collect(),
            Rule::Across { axis, near } => axis.iter().chain(near.iter().flatten()).collect(),
            Rule::Turn { axis, angle } => axis.iter().chain([angle]).collect(),
            Rule::Quaternion(list) => list.iter().collect(),
            Rule::Function(_) => Vec::new(),
        };
        let function = match self {
            Rule::Function(function) => Some(function.slots()),
            _ => None,
        };
        formulas.into_iter().flat_map(|f| f.slots()).chain(function.into_iter().flatten())
    }

    /// Is it a number that is a polynomial of at most first degree in these parameters?
    pub(super) fn is_linear_in(&self, moving: &dyn Fn(usize) -> bool) -> bool {
        match self {
            Rule::Number(f) | Rule::Quotient(f, _) => f.is_linear_in(moving),
            _ => self.parameters().all(|parameter| !moving(parameter)),
        }
    }
}

/// Axes further from a right angle than this (cosine) are a mistake, not a rounded number.
pub const ALMOST_RIGHT: f64 = 1e-3;

/// Printed quaternions are rounded; anything further off is a mistake.
const ROUNDED: f64 = 1e-3;

fn number(value: f64) -> Result<f64, Wrong> {
    if value.is_nan() {
        return Err((
            "the expression gives no finite number".to_string(),
            "choose other values of its parameters",
        ));
    }
    Ok(value)
}

fn unit(vector: Vector3<f64>) -> Result<Vector3<f64>, Wrong> {
    number(vector.sum())?;
    direction_of(&vector).ok_or_else(|| ("a direction must not be zero".to_string(), "for example [1, 0, 0]"))
}

/// The unit vector along a vector; None where that is zero.
pub fn direction_of(vector: &Vector3<f64>) -> Option<Vector3<f64>> {
    // Scaled first, so that neither tiny nor huge components are lost in the squares.
    let scale = vector.amax();
    (scale != 0.0).then(|| (vector / scale).normalize())
}

/// Rz(yaw) Ry(pitch) Rx(roll).
pub fn roll_pitch_yaw(rpy: &Vector3<f64>) -> UnitQuaternion<f64> {
    exp(&(Vector3::z() * rpy.z)) * exp(&(Vector3::y() * rpy.y)) * exp(&(Vector3::x() * rpy.x))
}
