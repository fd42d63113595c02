//! Files for NumPy: `.npz`.

use std::io::{self, Error, ErrorKind, Write};

mod array;

pub use array::{NpzArray, NpzValues};

/// Writes a `.npz` file for `numpy.load`: named arrays in an uncompressed ZIP archive.
///
/// Each array is written immediately; [`finish`](Self::finish) writes the directory of the archive. A file without its
/// directory, after a killed run or on a full disk, is incomplete; `zip -FF` recovers its complete arrays.
///
/// ```
/// use symplectic::files::Npz;
///
/// # fn main() -> std::io::Result<()> {
/// let mut file = Npz::new(Vec::new());
/// file.doubles("times", &[3], &[0.0, 0.5, 1.0])?;
/// file.text("note", "three times")?;
/// let bytes = file.finish()?;
/// assert!(bytes.starts_with(b"PK"));
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Npz<W> {
    out: W,
    offset: u32,
    directory: Vec<u8>,
    /// The names of the arrays.
    names: Vec<String>,
    /// Whether the last array is incomplete.
    broken: bool,
}

impl<W: Write> Npz<W> {
    /// A file without arrays.
    pub const fn new(out: W) -> Self {
        Self {
            out,
            offset: 0,
            directory: Vec::new(),
            names: Vec::new(),
            broken: false,
        }
    }

    /// Writes an array of doubles in C order, the last index fastest.
    ///
    /// # Errors
    ///
    /// I/O errors of the output, after which the file accepts no more arrays. [`ErrorKind::InvalidInput`] if the shape
    /// does not match the number of values, the name exists already, or the file would exceed 4 GiB. Write the
    /// shards of a large ensemble to separate files.
    pub fn doubles(&mut self, name: &str, shape: &[usize], values: &[f64]) -> io::Result<()> {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes());
        self.npy(name, "<f8", shape, values.len(), bytes)
    }

    /// Writes an array of unsigned integers.
    ///
    /// # Errors
    ///
    /// As for [`doubles`](Self::doubles).
    pub fn integers(&mut self, name: &str, shape: &[usize], values: &[u64]) -> io::Result<()> {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes());
        self.npy(name, "<u8", shape, values.len(), bytes)
    }

    /// Writes a string, as a scalar array.
    ///
    /// # Errors
    ///
    /// As for [`doubles`](Self::doubles).
    pub fn text(&mut self, name: &str, text: &str) -> io::Result<()> {
        self.letters(name, &[], &[text])
    }

    /// Writes a list of strings.
    ///
    /// # Errors
    ///
    /// As for [`doubles`](Self::doubles).
    pub fn texts(&mut self, name: &str, texts: &[&str]) -> io::Result<()> {
        self.letters(name, &[texts.len()], texts)
    }

    /// Writes an array that was read, with the same bytes if this library wrote it.
    ///
    /// # Errors
    ///
    /// As for [`doubles`](Self::doubles).
    pub fn array(&mut self, array: &NpzArray) -> io::Result<()> {
        let NpzArray {
            name,
            shape,
            values,
        } = array;
        match values {
            NpzValues::Doubles(values) => self.doubles(name, shape, values),
            NpzValues::Integers(values) => self.integers(name, shape, values),
            NpzValues::Texts(values) => {
                let texts: Vec<&str> = values.iter().map(String::as_str).collect();
                self.letters(name, shape, &texts)
            }
        }
    }

    /// Writes the directory, flushes, and returns the output.
    ///
    /// # Errors
    ///
    /// I/O errors of the output; an error if an array is incomplete.
    pub fn finish(mut self) -> io::Result<W> {
        self.check()?;
        let size = word(self.directory.len())?;
        let entries = u16::try_from(self.names.len()).map_err(|_| too_large())?;
        let mut end = b"PK\x05\x06\0\0\0\0".to_vec();
        for _ in 0..2 {
            end.extend(entries.to_le_bytes());
        }
        end.extend(size.to_le_bytes());
        end.extend(self.offset.to_le_bytes());
        end.extend([0, 0]);
        self.out.write_all(&self.directory)?;
        self.out.write_all(&end)?;
        self.out.flush()?;
        Ok(self.out)
    }

    /// Writes strings in UTF-32, padded with zeros to equal length.
    fn letters(&mut self, name: &str, shape: &[usize], texts: &[&str]) -> io::Result<()> {
        let lengths = texts.iter().map(|text| text.chars().count());
        let longest = lengths.max().unwrap_or(0).max(1);
        let padded = texts.iter().flat_map(|text| {
            let letters = text.chars().map(u32::from);
            letters.chain(core::iter::repeat(0)).take(longest)
        });
        let bytes = padded.flat_map(u32::to_le_bytes);
        self.npy(name, &format!("<U{longest}"), shape, texts.len(), bytes)
    }

    /// Writes an array in NPY 1.0 format.
    fn npy(
        &mut self,
        name: &str,
        kind: &str,
        shape: &[usize],
        count: usize,
        bytes: impl Iterator<Item = u8>,
    ) -> io::Result<()> {
        let size = shape
            .iter()
            .try_fold(1_usize, |size, &side| size.checked_mul(side));
        if size != Some(count) {
            return Err(invalid(format!(
                "array `{name}`: {count} elements do not fill the shape {shape:?}"
            )));
        }
        let sides: String = shape.iter().map(|side| format!("{side}, ")).collect();
        let mut header =
            format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({sides}), }}");
        // Ten bytes before the header and a newline after it; the total is padded to a multiple of 64 bytes.
        while (header.len() + 11) % 64 != 0 {
            header.push(' ');
        }
        header.push('\n');
        let mut file = b"\x93NUMPY\x01\0".to_vec();
        let length = u16::try_from(header.len()).map_err(|_| too_large())?;
        file.extend(length.to_le_bytes());
        file.extend(header.bytes());
        file.extend(bytes);
        self.entry(&format!("{name}.npy"), &file)
    }

    /// Writes a stored (uncompressed) file of the archive, dated 1 January 1980 (APPNOTE 6.3.10, 4.3.7 and 4.3.12).
    fn entry(&mut self, name: &str, file: &[u8]) -> io::Result<()> {
        self.check()?;
        if self.names.iter().any(|known| known == name) {
            return Err(invalid(format!(
                "there is an array `{name}` already: NumPy would read the last one only"
            )));
        }
        let letters = u16::try_from(name.len()).map_err(|_| too_large())?;
        let length = word(file.len())?;
        let end = u64::from(self.offset) + 30 + u64::from(letters) + u64::from(length);
        let end = u32::try_from(end).map_err(|_| too_large())?;
        if self.names.len() == usize::from(u16::MAX) {
            return Err(too_large());
        }
        // Version 2.0, names in UTF-8, stored.
        let mut common = [20, 0, 0, 8, 0, 0, 0, 0, 0x21, 0].to_vec();
        common.extend(crc32(file).to_le_bytes());
        common.extend(length.to_le_bytes());
        common.extend(length.to_le_bytes());
        common.extend(letters.to_le_bytes());
        common.extend([0, 0]);

        self.broken = true;
        self.out.write_all(b"PK\x03\x04")?;
        self.out.write_all(&common)?;
        self.out.write_all(name.as_bytes())?;
        self.out.write_all(file)?;

        self.directory.extend(b"PK\x01\x02\x14\0");
        self.directory.extend(common);
        self.directory.extend([0; 10]);
        self.directory.extend(self.offset.to_le_bytes());
        self.directory.extend(name.bytes());
        self.offset = end;
        self.names.push(name.into());
        self.broken = false;
        Ok(())
    }

    /// Returns an error after an incomplete array.
    fn check(&self) -> io::Result<()> {
        match self.broken {
            false => Ok(()),
            true => Err(Error::other(
                "an array is written in part only: begin a new file",
            )),
        }
    }
}

fn invalid(reason: String) -> Error {
    Error::new(ErrorKind::InvalidInput, reason)
}

fn too_large() -> Error {
    Error::new(
        ErrorKind::InvalidInput,
        "a .npz file of more than 4 GiB or 65535 arrays: write shards of the ensemble to files of their own",
    )
}

/// A byte count as a 32-bit field of the archive.
fn word(count: usize) -> io::Result<u32> {
    u32::try_from(count).map_err(|_| too_large())
}

/// The checksum of ZIP: CRC-32 with the reflected polynomial 0xEDB88320.
fn crc32(bytes: &[u8]) -> u32 {
    const TABLE: [u32; 256] = {
        let mut table = [0; 256];
        let mut byte = 0;
        while byte < 256 {
            let (mut rest, mut bit) = (byte as u32, 0);
            while bit < 8 {
                rest = (rest >> 1) ^ (0xEDB8_8320 * (rest & 1));
                bit += 1;
            }
            table[byte] = rest;
            byte += 1;
        }
        table
    };
    !bytes.iter().fold(!0, |sum, &byte| {
        (sum >> 8) ^ TABLE[((sum ^ u32::from(byte)) & 0xff) as usize]
    })
}

#[cfg(test)]
mod tests {
    use super::crc32;

    /// Check values of the catalogue of parametrised CRC algorithms (CRC-32/ISO-HDLC), and of the empty string.
    #[test]
    fn the_checksum_is_that_of_zip() {
        assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
        assert_eq!(crc32(b""), 0);
    }
}
