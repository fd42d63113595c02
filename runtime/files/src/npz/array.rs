//! Reads, checks and concatenates arrays of `.npz` files that this library wrote.

use std::io::{self, Error, ErrorKind};

use super::{crc32, invalid};

/// An array of a `.npz` file.
///
/// ```
/// use symplectic::files::{Npz, NpzArray, NpzValues};
///
/// # fn main() -> std::io::Result<()> {
/// let mut file = Npz::new(Vec::new());
/// file.doubles("q", &[2, 1], &[0.5, 1.5])?;
/// let mut first = NpzArray::read_all(&file.finish()?)?.remove(0);
/// let second = first.clone();
/// first.append(second)?;
/// assert_eq!((first.name.as_str(), first.shape), ("q", vec![4, 1]));
/// assert_eq!(first.values, NpzValues::Doubles(vec![0.5, 1.5, 0.5, 1.5]));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct NpzArray {
    /// Name, without `.npy`.
    pub name: String,
    /// Shape; empty for a scalar.
    pub shape: Vec<usize>,
    /// Values in C order, the last index fastest.
    pub values: NpzValues,
}

/// The values of an [`NpzArray`].
#[derive(Clone, Debug, PartialEq)]
pub enum NpzValues {
    /// Doubles, `<f8`.
    Doubles(Vec<f64>),
    /// Unsigned integers, `<u8`.
    Integers(Vec<u64>),
    /// Strings, `<U`.
    Texts(Vec<String>),
}

impl NpzArray {
    /// Reads all arrays of a file that [`Npz`](super::Npz) wrote, in their order.
    ///
    /// # Errors
    ///
    /// [`ErrorKind::InvalidData`] for a file that is truncated or modified (every array has a checksum), and for
    /// features that `Npz` does not write: compression, other number types.
    pub fn read_all(file: &[u8]) -> io::Result<Vec<Self>> {
        // The end-of-central-directory record, without a comment (APPNOTE 6.3.10, 4.3.16).
        let end = file.len().checked_sub(22).ok_or_else(cut_off)?;
        if part(file, end, 4)? != b"PK\x05\x06" {
            return Err(cut_off());
        }
        let mut at = number(file, end + 16, 4)?;
        let mut arrays = Vec::new();
        for _ in 0..number(file, end + 10, 2)? {
            let (array, next) = Self::entry(file, at)?;
            arrays.push(array);
            at = next;
        }
        match at == end {
            true => Ok(arrays),
            false => Err(damaged("its directory has another length")),
        }
    }

    /// Reads the array of the directory entry at this offset; also returns the offset of the next entry.
    fn entry(file: &[u8], at: usize) -> io::Result<(Self, usize)> {
        if part(file, at, 4)? != b"PK\x01\x02" {
            return Err(damaged("its directory is broken"));
        }
        let size = number(file, at + 20, 4)?;
        let letters = number(file, at + 28, 2)?;
        let local = number(file, at + 42, 4)?;
        let name = core::str::from_utf8(part(file, at + 46, letters)?)
            .map_err(|_| damaged("a name is not UTF-8"))?;
        let other = |what: String| Error::new(ErrorKind::InvalidData, format!("`{name}`: {what}"));
        if number(file, at + 10, 2)? != 0 {
            return Err(other("it is compressed, which is not read".to_string()));
        }
        if part(file, local, 4)? != b"PK\x03\x04"
            || part(file, local + 30, letters)? != name.as_bytes()
        {
            return Err(damaged("an array is not where its directory says"));
        }
        let skipped = number(file, local + 28, 2)?;
        let data = part(file, local + 30 + letters + skipped, size)?;
        if crc32(data) as usize != number(file, at + 16, 4)? {
            return Err(other(
                "its checksum does not match its contents".to_string(),
            ));
        }
        let (shape, values) = npy(data).map_err(|error| other(error.to_string()))?;
        let more = number(file, at + 30, 2)? + number(file, at + 32, 2)?;
        let array = Self {
            name: name.strip_suffix(".npy").unwrap_or(name).to_string(),
            shape,
            values,
        };
        Ok((array, at + 46 + letters + more))
    }

    /// Appends another array along the first index, like `numpy.concatenate`.
    ///
    /// # Errors
    ///
    /// [`ErrorKind::InvalidInput`] if name, value type or the lengths of the other indices differ, and for scalars; the
    /// array is then unchanged.
    pub fn append(&mut self, other: Self) -> io::Result<()> {
        let same = self.name == other.name
            && !self.shape.is_empty()
            && self.shape.len() == other.shape.len()
            && self.shape[1..] == other.shape[1..];
        match (&mut self.values, other.values) {
            (NpzValues::Doubles(own), NpzValues::Doubles(more)) if same => own.extend(more),
            (NpzValues::Integers(own), NpzValues::Integers(more)) if same => own.extend(more),
            (NpzValues::Texts(own), NpzValues::Texts(more)) if same => own.extend(more),
            _ => {
                return Err(invalid(format!(
                    "array `{}` of shape {:?} does not go after `{}` of shape {:?}: name, kind of values and all lengths but the first must be the same",
                    other.name, other.shape, self.name, self.shape
                )));
            }
        }
        self.shape[0] += other.shape[0];
        Ok(())
    }
}

/// Shape and values of an NPY 1.0 file with the header that [`Npz`](super::Npz) writes.
fn npy(file: &[u8]) -> io::Result<(Vec<usize>, NpzValues)> {
    let strange =
        || damaged("no header of NPY 1.0 with numbers in little-endian order and C order");
    if part(file, 0, 8)? != b"\x93NUMPY\x01\0" {
        return Err(strange());
    }
    let length = number(file, 8, 2)?;
    let header = core::str::from_utf8(part(file, 10, length)?).map_err(|_| strange())?;
    let between = |before: &str, after: &str| {
        let (_, rest) = header.split_once(before)?;
        rest.split_once(after).map(|(found, _)| found)
    };
    let kind = between("'descr': '", "'").ok_or_else(strange)?;
    let sides = between("'fortran_order': False, 'shape': (", ")").ok_or_else(strange)?;
    let sides = sides
        .split(',')
        .map(str::trim)
        .filter(|side| !side.is_empty());
    let shape: Vec<usize> = sides
        .map(|side| side.parse().map_err(|_| strange()))
        .collect::<io::Result<_>>()?;
    let (width, unit) = match kind.strip_prefix("<U") {
        Some(letters) => (letters.parse::<usize>().map_err(|_| strange())?, 4),
        None => (1, 8),
    };
    let data = &file[10 + length..];
    let size = shape.iter().chain([&width, &unit]);
    let size = size.copied().try_fold(1_usize, usize::checked_mul);
    if size != Some(data.len()) || width == 0 {
        return Err(damaged("its values do not fill its shape"));
    }
    let (words, _) = data.as_chunks::<8>();
    let values = match kind {
        "<f8" => NpzValues::Doubles(words.iter().copied().map(f64::from_le_bytes).collect()),
        "<u8" => NpzValues::Integers(words.iter().copied().map(u64::from_le_bytes).collect()),
        _ if kind.starts_with("<U") => {
            let (letters, _) = data.as_chunks::<4>();
            let texts = letters.chunks(width).map(text).collect::<Option<_>>();
            NpzValues::Texts(texts.ok_or_else(|| damaged("a text is not Unicode"))?)
        }
        _ => return Err(damaged("its numbers are neither `<f8` nor `<u8`")),
    };
    Ok((shape, values))
}

/// A UTF-32 string, without trailing zeros.
fn text(letters: &[[u8; 4]]) -> Option<String> {
    let letters = letters.iter().copied().map(u32::from_le_bytes);
    let text: Option<String> = letters.map(char::from_u32).collect();
    text.map(|text| text.trim_end_matches('\0').to_string())
}

/// Bytes of a file.
fn part(file: &[u8], at: usize, length: usize) -> io::Result<&[u8]> {
    let end = at.checked_add(length);
    end.and_then(|end| file.get(at..end)).ok_or_else(cut_off)
}

/// A little-endian number of at most four bytes.
fn number(file: &[u8], at: usize, bytes: usize) -> io::Result<usize> {
    let bytes = part(file, at, bytes)?.iter().rev();
    Ok(bytes.fold(0, |sum, byte| sum << 8 | usize::from(*byte)))
}

fn cut_off() -> Error {
    damaged("it is cut off")
}

fn damaged(reason: &str) -> Error {
    Error::new(
        ErrorKind::InvalidData,
        format!("not a file written by `Npz`, or damaged: {reason}"),
    )
}
