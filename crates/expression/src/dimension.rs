//! Dimensions: exponents of length, mass, time, temperature and angle.

use std::fmt;

/// Exponents are kept in twelfths, so that square, cube and fourth roots are exact.
const WHOLE: i32 = 12;

/// A physical dimension. Angle is remembered but counts as a plain number wherever two dimensions are
/// compared: N·m/rad and N·m agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Dimension {
    /// Length, mass, time, temperature, angle; in twelfths.
    exponents: [i32; 5],
}

const fn dimension(length: i32, mass: i32, time: i32, temperature: i32, angle: i32) -> Dimension {
    Dimension { exponents: [length * WHOLE, mass * WHOLE, time * WHOLE, temperature * WHOLE, angle * WHOLE] }
}

macro_rules! named {
    ($($constant:ident = ($l:expr, $m:expr, $t:expr, $k:expr, $a:expr), $name:literal, $unit:literal;)*) => {
        #[allow(missing_docs)] // Each is its own documentation.
        impl Dimension {
            $(pub const $constant: Dimension = dimension($l, $m, $t, $k, $a);)*
        }
        const NAMED: &[(Dimension, &str, &str)] = &[$((Dimension::$constant, $name, $unit)),*];
    };
}

named! {
    NUMBER = (0, 0, 0, 0, 0), "a plain number", "";
    ANGLE = (0, 0, 0, 0, 1), "an angle", "rad";
    LENGTH = (1, 0, 0, 0, 0), "a length", "m";
    AREA = (2, 0, 0, 0, 0), "an area", "m^2";
    VOLUME = (3, 0, 0, 0, 0), "a volume", "m^3";
    AREA_MOMENT = (4, 0, 0, 0, 0), "a second moment of area", "m^4";
    CURVATURE = (-1, 0, 0, 0, 0), "a curvature", "1/m";
    TWIST_RATE = (-1, 0, 0, 0, 1), "a curvature", "rad/m";
    MASS = (0, 1, 0, 0, 0), "a mass", "kg";
    MASS_PER_LENGTH = (-1, 1, 0, 0, 0), "a mass per length", "kg/m";
    ROTARY_INERTIA = (1, 1, 0, 0, 0), "a moment of inertia per length", "kg*m";
    DENSITY = (-3, 1, 0, 0, 0), "a density", "kg/m^3";
    INERTIA = (2, 1, 0, 0, 0), "a moment of inertia", "kg*m^2";
    TIME = (0, 0, 1, 0, 0), "a time", "s";
    FREQUENCY = (0, 0, -1, 0, 0), "a frequency", "1/s";
    ANGULAR_VELOCITY = (0, 0, -1, 0, 1), "an angular velocity", "rad/s";
    ANGULAR_ACCELERATION = (0, 0, -2, 0, 1), "an angular acceleration", "rad/s^2";
    VELOCITY = (1, 0, -1, 0, 0), "a velocity", "m/s";
    ACCELERATION = (1, 0, -2, 0, 0), "an acceleration", "m/s^2";
    FORCE = (1, 1, -2, 0, 0), "a force", "N";
    MOMENT = (2, 1, -2, 0, 0), "a moment", "N*m";
    ANGULAR_STIFFNESS = (2, 1, -2, 0, -1), "an angular stiffness", "N*m/rad";
    PRESSURE = (-1, 1, -2, 0, 0), "a pressure", "Pa";
    STIFFNESS = (0, 1, -2, 0, 0), "a force per length", "N/m";
    BENDING_STIFFNESS = (3, 1, -2, 0, 0), "a bending stiffness", "N*m^2";
    FORCE_PER_VOLUME = (-2, 1, -2, 0, 0), "a force per volume", "N/m^3";
    POWER = (2, 1, -3, 0, 0), "a power", "W";
    POWER_OF_MOMENT = (2, 1, -3, 0, 1), "a power", "W";
    TEMPERATURE = (0, 0, 0, 1, 0), "a temperature", "K";
    PITCH = (1, 0, 0, 0, -1), "a length per angle", "m/rad";
    FORCE_PER_ANGLE = (1, 1, -2, 0, -1), "a force per angle", "N/rad";
    COMPLIANCE = (0, -1, 2, 0, 0), "a compliance", "m/N";
    TURN_PER_FORCE = (-1, -1, 2, 0, 1), "an angle per force", "rad/N";
    LENGTH_PER_MOMENT = (-1, -1, 2, 0, 0), "a length per moment", "1/N";
    DAMPING = (0, 1, -1, 0, 0), "a force per velocity", "N*s/m";
    ANGULAR_DAMPING = (2, 1, -1, 0, -1), "a moment per angular velocity", "N*m*s/rad";
    ANGULAR_COMPLIANCE = (-2, -1, 2, 0, 1), "an angular compliance", "rad/N/m";
}

impl Dimension {
    /// Do the two agree, angle counting as a plain number?
    pub fn agrees(&self, other: &Dimension) -> bool {
        self.exponents[..4] == other.exponents[..4]
    }

    /// Is it a plain number or an angle?
    pub fn is_number(&self) -> bool {
        self.exponents[..4] == [0; 4]
    }

    /// Is it an angle (and not a plain number)?
    pub fn is_angle(&self) -> bool {
        self.is_number() && self.exponents[4] != 0
    }

    /// The dimension of a product.
    pub fn times(&self, other: &Dimension) -> Dimension {
        self.combine(other, 1)
    }

    /// The dimension of a quotient.
    pub fn over(&self, other: &Dimension) -> Dimension {
        self.combine(other, -1)
    }

    fn combine(&self, other: &Dimension, sign: i32) -> Dimension {
        let mut exponents = self.exponents;
        for (mine, theirs) in exponents.iter_mut().zip(other.exponents) {
            *mine = mine.saturating_add(theirs.saturating_mul(sign));
        }
        Dimension { exponents }
    }

    /// The dimension to a power; None when an exponent is no whole number of twelfths or absurdly large.
    pub(crate) fn power(&self, power: f64) -> Option<Dimension> {
        let mut exponents = [0; 5];
        for (new, old) in exponents.iter_mut().zip(self.exponents) {
            let exact = f64::from(old) * power;
            let rounded = exact.round();
            // 1/3 is not a binary number, hence the tolerance.
            let whole = (exact - rounded).abs() < 1e-9 && rounded.abs() <= f64::from(1000 * WHOLE);
            if !whole {
                return None;
            }
            *new = rounded as i32;
        }
        Some(Dimension { exponents })
    }

    /// Its SI unit as text that can be read back: "N", "kg/m^3", "" for a plain number. A radian is told only where
    /// it belongs to a quantity that people know by it, as an angle or N*m/rad; kg*rad is kg.
    pub fn unit(&self) -> String {
        let exact = NAMED.iter().find(|(dimension, ..)| dimension == self);
        if let Some((_, _, unit)) =
            exact.or_else(|| NAMED.iter().find(|(dimension, ..)| dimension.agrees(self)))
        {
            return (*unit).to_string();
        }
        let mut over = String::new();
        let mut under = String::new();
        for (exponent, symbol) in self.exponents.iter().zip(["m", "kg", "s", "K"]) {
            let side = match exponent.signum() {
                0 => continue,
                1 => &mut over,
                _ => &mut under,
            };
            side.push(if *exponent > 0 { '*' } else { '/' });
            side.push_str(symbol);
            if exponent.abs() != WHOLE {
                side.push_str(&format!("^{}", f64::from(exponent.abs()) / f64::from(WHOLE)));
            }
        }
        let over = if over.is_empty() { "1" } else { &over[1..] };
        format!("{over}{under}")
    }
}

impl fmt::Display for Dimension {
    /// "a length (m)", "a plain number", "a quantity in m^5".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let exact = NAMED.iter().find(|(dimension, ..)| dimension == self);
        match exact.or_else(|| NAMED.iter().find(|(dimension, ..)| dimension.agrees(self))) {
            Some((_, name, "")) => write!(f, "{name}"),
            Some((_, name, unit)) => write!(f, "{name} ({unit})"),
            None => write!(f, "a quantity in {}", self.unit()),
        }
    }
}

/// What is known of a value's dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Made of plain numbers only: counts as SI in whatever dimension is wanted.
    Plain,
    /// Made of at least one number with a unit.
    Of(Dimension),
}

impl Kind {
    /// The dimension, a plain number counting as dimensionless.
    pub fn dimension(&self) -> Dimension {
        match self {
            Kind::Plain => Dimension::NUMBER,
            Kind::Of(dimension) => *dimension,
        }
    }

    /// May a value of this kind stand where `wanted` is expected? Plain numbers may stand anywhere; an
    /// angle may not stand where a plain number or anything else is wanted.
    pub fn fits(&self, wanted: &Dimension) -> bool {
        match self {
            Kind::Plain => true,
            Kind::Of(dimension) if dimension.is_angle() => wanted.is_angle(),
            Kind::Of(dimension) => dimension.is_number() || dimension.agrees(wanted),
        }
    }
}

/// A number with what is known of its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// In SI units.
    pub value: f64,
    /// Its dimension.
    pub kind: Kind,
}

impl Quantity {
    /// A number without a unit.
    pub fn plain(value: f64) -> Self {
        Self { value, kind: Kind::Plain }
    }
}
