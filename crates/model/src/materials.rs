//! Materials of which flexures are made, with where their numbers come from.
//!
//! Values at room temperature, as they are printed there. Strengths are given where an alloy's condition decides them; of what is sold in
//! many tempers they are not.

use crate::Material;

/// An entry of the library.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnownMaterial {
    /// As a model file calls it.
    pub name: &'static str,
    /// What it is.
    pub what: &'static str,
    /// Young's modulus, Pa; of fibres and crystals along the beam.
    pub young: f64,
    /// What says how it shears.
    pub shear: Shear,
    /// kg/m³.
    pub density: f64,
    /// Pa; None where the temper decides.
    pub yield_strength: Option<f64>,
    /// °C.
    pub temperature: f64,
    /// Where the numbers are printed.
    pub source: &'static str,
}

/// How a shear modulus is printed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shear {
    /// By Poisson's ratio.
    Poisson(f64),
    /// By itself, Pa.
    Modulus(f64),
}

impl KnownMaterial {
    /// G, Pa, with this E.
    pub fn shear_with(&self, young: f64) -> f64 {
        match self.shear {
            Shear::Poisson(poisson) => young / (2.0 * (1.0 + poisson)),
            Shear::Modulus(shear) => shear,
        }
    }

    /// As a material of a model.
    pub fn material(&self) -> Material {
        Material {
            name: self.name.to_string(),
            young: self.young,
            shear: self.shear_with(self.young),
            density: Some(self.density),
            yield_strength: self.yield_strength,
        }
    }
}

/// The entry of this name.
pub fn known_material(name: &str) -> Option<&'static KnownMaterial> {
    MATERIALS.iter().find(|known| known.name == name)
}

const GPA: f64 = 1e9;
const MPA: f64 = 1e6;
const ROOM: f64 = 20.0;
const CALLISTER: &str = "W. D. Callister, Materials Science and Engineering, 7th ed. (2007), appendix B";
const TSAI: &str = "S. W. Tsai and H. T. Hahn, Introduction to Composite Materials (1980), table 1.7";
const HOPCROFT: &str = "M. A. Hopcroft, W. D. Nix and T. W. Kenny, J. Microelectromech. Syst. 19 (2010) 229";

/// The library.
pub const MATERIALS: [KnownMaterial; 15] = [
    KnownMaterial {
        name: "spring-steel",
        what: "patented cold-drawn carbon steel",
        young: 206.0 * GPA,
        shear: Shear::Modulus(81.5 * GPA),
        density: 7850.0,
        yield_strength: None,
        temperature: ROOM,
        source: "EN 10270-1",
    },
    KnownMaterial {
        name: "stainless-1.4310",
        what: "cold-drawn stainless spring steel, AISI 302",
        young: 185.0 * GPA,
        shear: Shear::Modulus(73.0 * GPA),
        density: 8000.0,
        yield_strength: None,
        temperature: ROOM,
        source: "EN 10270-3",
    },
    KnownMaterial {
        name: "aluminium-6061-t6",
        what: "aluminium alloy, artificially aged",
        young: 69.0 * GPA,
        shear: Shear::Poisson(0.33),
        density: 2700.0,
        yield_strength: Some(276.0 * MPA),
        temperature: ROOM,
        source: CALLISTER,
    },
    KnownMaterial {
        name: "aluminium-7075-t6",
        what: "aluminium alloy, artificially aged",
        young: 71.0 * GPA,
        shear: Shear::Poisson(0.33),
        density: 2800.0,
        yield_strength: Some(505.0 * MPA),
        temperature: ROOM,
        source: CALLISTER,
    },
    KnownMaterial {
        name: "titanium-6al-4v",
        what: "titanium alloy, annealed",
        young: 114.0 * GPA,
        shear: Shear::Poisson(0.34),
        density: 4430.0,
        yield_strength: Some(830.0 * MPA),
        temperature: ROOM,
        source: CALLISTER,
    },
    KnownMaterial {
        name: "copper-beryllium-c17200",
        what: "copper with 2 % beryllium",
        young: 128.0 * GPA,
        shear: Shear::Poisson(0.30),
        density: 8250.0,
        yield_strength: None,
        temperature: ROOM,
        source: CALLISTER,
    },
    KnownMaterial {
        name: "phosphor-bronze-c51000",
        what: "bronze with 5 % tin",
        young: 110.0 * GPA,
        shear: Shear::Poisson(0.34),
        density: 8860.0,
        yield_strength: None,
        temperature: ROOM,
        source: "ASTM B103, alloy data of Olin Brass",
    },
    KnownMaterial {
        name: "nitinol-austenite",
        what: "nickel-titanium above its transformation, up to about 1 % of strain",
        young: 83.0 * GPA,
        shear: Shear::Poisson(0.33),
        density: 6450.0,
        yield_strength: None,
        temperature: ROOM,
        source: "T. W. Duerig and A. R. Pelton, in Materials Properties Handbook: Titanium Alloys, ASM (1994)",
    },
    KnownMaterial {
        name: "silicon-110",
        what: "silicon of a (100) wafer, along <110>; G is that in the wafer's plane",
        young: 169.0 * GPA,
        shear: Shear::Modulus(50.9 * GPA),
        density: 2329.0,
        yield_strength: None,
        temperature: ROOM,
        source: HOPCROFT,
    },
    KnownMaterial {
        name: "silicon-100",
        what: "silicon of a (100) wafer, along <100>; G is that in the wafer's plane",
        young: 130.0 * GPA,
        shear: Shear::Modulus(79.6 * GPA),
        density: 2329.0,
        yield_strength: None,
        temperature: ROOM,
        source: HOPCROFT,
    },
    KnownMaterial {
        name: "polypropylene",
        what: "the middle of 1.14 to 1.55 GPa; it creeps",
        young: 1.35 * GPA,
        shear: Shear::Poisson(0.40),
        density: 905.0,
        yield_strength: Some(31.0 * MPA),
        temperature: ROOM,
        source: CALLISTER,
    },
    KnownMaterial {
        name: "pla",
        what: "polylactide, dense; printed parts are softer",
        young: 3.6 * GPA,
        shear: Shear::Poisson(0.36),
        density: 1240.0,
        yield_strength: Some(60.0 * MPA),
        temperature: ROOM,
        source: "NatureWorks, data sheet of Ingeo 4043D; Poisson's ratio is a usual one",
    },
    KnownMaterial {
        name: "peek",
        what: "polyetheretherketone without fibres",
        young: 4.0 * GPA,
        shear: Shear::Poisson(0.40),
        density: 1300.0,
        yield_strength: Some(98.0 * MPA),
        temperature: ROOM,
        source: "Victrex, data sheet of PEEK 450G; Poisson's ratio is a usual one",
    },
    KnownMaterial {
        name: "carbon-epoxy-ud",
        what: "T300/5208 with its fibres along the beam",
        young: 181.0 * GPA,
        shear: Shear::Modulus(7.17 * GPA),
        density: 1600.0,
        yield_strength: None,
        temperature: ROOM,
        source: TSAI,
    },
    KnownMaterial {
        name: "glass-epoxy-ud",
        what: "Scotchply 1002 with its fibres along the beam",
        young: 38.6 * GPA,
        shear: Shear::Modulus(4.14 * GPA),
        density: 1800.0,
        yield_strength: None,
        temperature: ROOM,
        source: TSAI,
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_has_a_name_of_its_own_and_numbers_of_a_material() {
        for (i, known) in MATERIALS.iter().enumerate() {
            assert!(MATERIALS[..i].iter().all(|other| other.name != known.name), "{}", known.name);
            assert_eq!(known_material(known.name), Some(known));
            let material = known.material();
            // Nothing that flexures are made of lies outside.
            assert!((0.5 * GPA..300.0 * GPA).contains(&material.young), "{}", known.name);
            assert!(
                material.shear < material.young && material.shear > 0.02 * material.young,
                "{}",
                known.name
            );
            assert!((500.0..10_000.0).contains(&known.density) && !known.source.is_empty(), "{}", known.name);
            // What is isotropic has a ratio of a solid's; crystals and fibres have none.
            let has_direction = known.name.contains("silicon") || known.name.ends_with("-ud");
            let ratio = material.young / (2.0 * material.shear) - 1.0;
            assert!(has_direction || (0.2..0.45).contains(&ratio), "{}: {ratio}", known.name);
        }
    }
}
