//! `model.vtp`: VTK XML PolyData for ParaView and PyVista.
//!
//! One polyline a beam through the deformed samples. Numbers are written as inline base64 (a 32-bit byte
//! count, then the little-endian values), which is exact and can hold NaN where a beam has no stress.

use flexura_model::Model;
use flexura_post::Evaluation;
use flexura_solution::{BeamSample, Solution};
use flexura_spatial::Vector3;

/// The deformed beams with their fields.
///
/// Point data: `s`, `displacement`, `force`, `moment`, `curvature`, `stretch`, `director_e1`,
/// `director_e2`, `director_e3`, `strain`, `stress` (the last two NaN for a section given as a stiffness).
/// Cell data: `beam`, the beam's position in the model. Field data: `beam_names`.
pub fn model_vtp(model: &Model, solution: &Solution, evaluation: &Evaluation) -> String {
    let samples: Vec<&BeamSample> = solution.beams.iter().flat_map(|beam| &beam.samples).collect();
    let lines: Vec<usize> = solution.beams.iter().map(|beam| beam.samples.len()).collect();
    let mut ends = Vec::with_capacity(lines.len());
    for count in &lines {
        ends.push(ends.last().copied().unwrap_or(0) + *count as i64);
    }
    let stress: Vec<[f64; 2]> = solution
        .beams
        .iter()
        .zip(&evaluation.beams)
        .flat_map(|(beam, stress)| {
            (0..beam.samples.len()).map(move |i| match stress {
                Some(stress) => [stress.samples[i].strain, stress.samples[i].von_mises],
                None => [f64::NAN; 2],
            })
        })
        .collect();

    let vectors = |name: &str, pick: &dyn Fn(&BeamSample) -> Vector3<f64>| {
        let values: Vec<f64> = samples.iter().flat_map(|sample| <[f64; 3]>::from(pick(sample))).collect();
        floats(name, 3, &values)
    };
    let scalars = |name: &str, pick: &dyn Fn(&BeamSample) -> f64| {
        floats(name, 1, &samples.iter().map(|sample| pick(sample)).collect::<Vec<_>>())
    };
    let director = |axis: Vector3<f64>| move |sample: &BeamSample| sample.pose.rotation * axis;

    let mut text = String::from(concat!(
        "<?xml version=\"1.0\"?>\n",
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n",
        "<PolyData>\n<FieldData>\n",
    ));
    text += &names(&model.beams.iter().map(|beam| beam.name.as_str()).collect::<Vec<_>>());
    text += &format!(
        "</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
        samples.len(),
        lines.len()
    );
    text += "<PointData>\n";
    text += &scalars("s", &|sample| sample.s);
    text += &vectors("displacement", &|sample| sample.pose.position - sample.rest_pose.position);
    text += &vectors("force", &|sample| sample.wrench.force);
    text += &vectors("moment", &|sample| sample.wrench.moment);
    text += &vectors("curvature", &|sample| sample.curvature);
    text += &scalars("stretch", &|sample| sample.strain.x);
    text += &vectors("director_e1", &director(Vector3::x()));
    text += &vectors("director_e2", &director(Vector3::y()));
    text += &vectors("director_e3", &director(Vector3::z()));
    text += &floats("strain", 1, &stress.iter().map(|pair| pair[0]).collect::<Vec<_>>());
    text += &floats("stress", 1, &stress.iter().map(|pair| pair[1]).collect::<Vec<_>>());
    text += "</PointData>\n<CellData>\n";
    text += &integers("beam", &(0..lines.len() as i64).collect::<Vec<_>>());
    text += "</CellData>\n<Points>\n";
    text += &vectors("Points", &|sample| sample.pose.position);
    text += "</Points>\n<Lines>\n";
    text += &integers("connectivity", &(0..samples.len() as i64).collect::<Vec<_>>());
    text += &integers("offsets", &ends);
    text += "</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n";
    text
}

fn floats(name: &str, components: usize, values: &[f64]) -> String {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    array("Float64", name, &format!("NumberOfComponents=\"{components}\""), &bytes)
}

fn integers(name: &str, values: &[i64]) -> String {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    array("Int64", name, "NumberOfComponents=\"1\"", &bytes)
}

/// Strings are stored one after another, each closed by a zero byte.
fn names(names: &[&str]) -> String {
    let bytes: Vec<u8> = names.iter().flat_map(|name| name.bytes().chain([0])).collect();
    array("String", "beam_names", &format!("NumberOfTuples=\"{}\"", names.len()), &bytes)
}

fn array(kind: &str, name: &str, attributes: &str, bytes: &[u8]) -> String {
    let mut block = (bytes.len() as u32).to_le_bytes().to_vec();
    block.extend_from_slice(bytes);
    format!(
        "<DataArray type=\"{kind}\" Name=\"{name}\" {attributes} format=\"binary\">{}</DataArray>\n",
        base64(&block)
    )
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let at = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
        let group = at(0) << 16 | at(1) << 8 | at(2);
        for digit in 0..4 {
            if digit <= chunk.len() {
                text.push(char::from(DIGITS[(group >> (18 - 6 * digit) & 63) as usize]));
            } else {
                text.push('=');
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::base64;

    #[test]
    fn base64_pads_as_rfc_4648_says() {
        let cases = [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")];
        for (plain, coded) in cases {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }
}
