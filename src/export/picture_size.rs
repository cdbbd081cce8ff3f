//! The size of a picture that another decoder is to decode, from its header.

use super::{
    jpeg::{is_jpeg, jpeg_size},
    png::{is_png, png_size},
    webp::{is_webp, webp_size},
};

/// Maximum number of pixels of a picture that a browser decodes for a thumbnail: 128 MiB of four bytes each.
pub const MAX_DECODED_PIXELS: u64 = 1 << 25;

/// Width and height in pixels of a PNG, a JPEG or a WebP with metadata that begins with `start`.
///
/// Those are the pictures that can contain a scene, except for OpenEXR, which browsers do not decode.
///
/// # Errors
/// A message for the user: another file, or more than [`MAX_DECODED_PIXELS`]. A file of some kilobytes can name
/// gigabytes of pixels, which browsers allocate.
pub fn decodable_size(start: &[u8]) -> Result<[u32; 2], String> {
    let size = if is_png(start) {
        png_size(start)
    } else if is_jpeg(start) {
        jpeg_size(start)
    } else if is_webp(start) {
        webp_size(start)
    } else {
        return Err("it is no PNG, no JPEG and no WebP".to_owned());
    };
    let [width, height] = size.map_err(|error| error.to_string())?;
    let pixels = u64::from(width) * u64::from(height);
    if pixels > MAX_DECODED_PIXELS {
        return Err(format!(
            "it has {width} x {height} pixels, and thumbnails are made of at most {MAX_DECODED_PIXELS}"
        ));
    }
    Ok([width, height])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        export::{PictureFormat, encode_rgb},
        scene::Scene,
    };

    const SIZE_PX: [u32; 2] = [5, 4];

    /// A file of each format that browsers decode, and where its width and height are.
    fn files() -> [(Vec<u8>, [usize; 2]); 3] {
        let position = |file: &[u8], bytes: &[u8]| {
            file.windows(bytes.len()).position(|at| at == bytes).expect("a size")
        };
        let file = |format| {
            encode_rgb(format, 90, SIZE_PX, &Scene::default(), &[99; 60]).expect("a picture")
        };
        let [png, jpeg, webp] =
            [PictureFormat::Png, PictureFormat::Jpeg, PictureFormat::WebP].map(file);
        let frame = position(&jpeg, &[0, 4, 0, 5]);
        [(png, [16, 20]), (jpeg, [frame + 2, frame]), (webp, [24, 27])]
    }

    #[test]
    fn sizes_are_those_of_the_header() {
        for (file, _) in files() {
            assert_eq!(decodable_size(&file), Ok(SIZE_PX));
        }
    }

    #[test]
    fn progressive_jpegs_have_their_size_too() {
        let file = b"\xFF\xD8\xFF\xC2\x00\x0B\x08\x00\x04\x00\x05\x01\x01\x11\x00";
        assert_eq!(decodable_size(file), Ok(SIZE_PX));
    }

    #[test]
    fn more_pixels_than_a_browser_should_decode_are_refused() {
        // Width and height of each format, as bytes: too many pixels, and as many as are taken.
        let sides: [fn(u32) -> Vec<u8>; 3] = [
            |side| side.to_be_bytes().to_vec(),
            |side| (side as u16).to_be_bytes().to_vec(),
            |side| (side - 1).to_le_bytes()[..3].to_vec(),
        ];
        for ((file, places), bytes) in files().into_iter().zip(sides) {
            for (size, is_taken) in
                [([8192, 4096], true), ([8193, 4096], false), ([16384; 2], false)]
            {
                let mut file = file.clone();
                for (place, side) in places.into_iter().zip(size) {
                    file.splice(place..place + bytes(side).len(), bytes(side));
                }
                let said = decodable_size(&file);
                match is_taken {
                    true => assert_eq!(said, Ok(size)),
                    false => assert!(said.unwrap_err().contains(&format!("{} x", size[0]))),
                }
            }
        }
    }

    #[test]
    fn files_that_end_before_their_size_are_refused() {
        for (file, _) in files() {
            let shortest = (0..file.len()).find(|&end| decodable_size(&file[..end]).is_ok());
            let shortest = shortest.expect("a size");
            assert!(
                shortest > 20
                    && (shortest..file.len()).all(|end| decodable_size(&file[..end]).is_ok())
            );
        }
        for other in [&b""[..], b"GIF89a\x01\x00\x01\x00"] {
            assert!(decodable_size(other).is_err());
        }
    }
}
