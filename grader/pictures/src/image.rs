//! A picture of bytes.

/// The bytes of a pixel: red, green, blue.
pub type Rgb = [u8; 3];

/// A picture: rows from the top, each from the left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    size: [u32; 2],
    pixels: Vec<Rgb>,
}

impl Image {
    /// A picture of `width` by `height` pixels of one colour.
    pub fn filled(size: [u32; 2], colour: Rgb) -> Image {
        Image::from_fn(size, |_, _| colour)
    }

    /// A picture whose pixel in column `x` and row `y` from the top is `colour(x, y)`.
    pub fn from_fn([w, h]: [u32; 2], mut colour: impl FnMut(u32, u32) -> Rgb) -> Image {
        let places = (0..h).flat_map(|y| (0..w).map(move |x| (x, y)));
        Image {
            size: [w, h],
            pixels: places.map(|(x, y)| colour(x, y)).collect(),
        }
    }

    /// A picture from its bytes; `None` if their number does not fit the size.
    pub fn from_bytes(size: [u32; 2], bytes: &[u8]) -> Option<Image> {
        let (pixels, rest) = bytes.as_chunks::<3>();
        let fits = rest.is_empty() && pixels.len() == size[0] as usize * size[1] as usize;
        fits.then(|| Image {
            size,
            pixels: pixels.to_vec(),
        })
    }

    /// Width and height.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The pixels, row by row from the top left.
    pub fn pixels(&self) -> &[Rgb] {
        &self.pixels
    }

    /// The bytes of all pixels, row by row from the top left.
    pub fn bytes(&self) -> &[u8] {
        self.pixels.as_flattened()
    }

    /// The pixel in column `x` and row `y` from the top.
    ///
    /// # Panics
    ///
    /// If it is outside of the picture.
    pub fn get(&self, x: u32, y: u32) -> Rgb {
        self.pixels[self.index(x, y)]
    }

    /// Sets the pixel in column `x` and row `y` from the top.
    ///
    /// # Panics
    ///
    /// If it is outside of the picture.
    pub fn set(&mut self, x: u32, y: u32, colour: Rgb) {
        let index = self.index(x, y);
        self.pixels[index] = colour;
    }

    /// Copies `part` to the place whose top left corner is in column `x` and row `y`. What would be
    /// outside of this picture is left out.
    pub fn paste(&mut self, part: &Image, x: u32, y: u32) {
        let [w, h] = part.size;
        for row in 0..h.min(self.size[1].saturating_sub(y)) {
            for column in 0..w.min(self.size[0].saturating_sub(x)) {
                self.set(x + column, y + row, part.get(column, row));
            }
        }
    }

    fn index(&self, x: u32, y: u32) -> usize {
        assert!(
            x < self.size[0] && y < self.size[1],
            "pixel ({x}, {y}) is outside of a picture of {:?}",
            self.size
        );
        y as usize * self.size[0] as usize + x as usize
    }
}
