//! The charcoal drawing's three textures, made once for all pictures with the same settings.

use crate::error::{Error, Result};
use crate::picture::Picture;
use crate::settings::{Kind, Problem, Value};
use crate::textures::{ContrastTexture, LARGEST_SIDE_PX, NoiseTexture, PaperTexture, height_of};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// The source of one of the drawing's textures.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum TextureSource {
    /// Made from the seed.
    #[default]
    Made,
    /// A picture of the user's.
    File {
        /// Its source file.
        path: PathBuf,
        /// The picture; its alpha is not used.
        picture: Arc<Picture>,
    },
}

impl TextureSource {
    /// Reads a picture.
    ///
    /// # Errors
    ///
    /// [`Error::File`] when it cannot be read.
    pub fn read(path: &Path) -> Result<Self> {
        // Transparent paper would make the drawing's own alpha negative, and so would a transparent grain.
        let picture = Arc::new(Picture::read(path)?.opaque());
        Ok(Self::File { path: path.to_path_buf(), picture })
    }

    /// Returns the picture of the file, or else makes one.
    fn or_made(&self, make: impl FnOnce() -> Result<Picture>) -> Result<Arc<Picture>> {
        match self {
            Self::Made => make().map(Arc::new),
            Self::File { picture, .. } => Ok(picture.clone()),
        }
    }

    /// Its file.
    pub(crate) fn path(&self) -> Option<&Path> {
        match self {
            Self::Made => None,
            Self::File { path, .. } => Some(path),
        }
    }
}

/// The name of a generated texture.
const MADE: &str = "made";

impl Value for TextureSource {
    fn kind() -> Kind {
        Kind::File
    }

    fn text(&self) -> String {
        match self {
            Self::Made => MADE.to_owned(),
            Self::File { path, .. } => path.to_string_lossy().into_owned(),
        }
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(if text == MADE { Self::Made } else { Self::read(Path::new(text))? })
    }
}

/// Textures kept for the next picture; shared between clones. Any two compare equal, because the settings determine them.
#[derive(Debug, Clone, Default)]
pub struct CharcoalPictures(Arc<Mutex<Option<(TextureSettings, CharcoalTextures)>>>);

impl PartialEq for CharcoalPictures {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// The settings that determine the textures.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TextureSettings {
    pub contrast: ContrastTexture,
    pub noise: NoiseTexture,
    /// Sources of noise, contrast-enhanced texture and paper.
    pub sources: [TextureSource; 3],
    /// Whether the drawing needs the paper's height.
    pub has_tooth: bool,
}

/// The textures.
#[derive(Debug, Clone)]
pub(super) struct CharcoalTextures {
    pub noise: Arc<Picture>,
    pub cet: Arc<Picture>,
    pub paper: Arc<Picture>,
    /// The paper's height, if the drawing needs it.
    pub tooth: Option<Arc<Picture>>,
}

impl CharcoalPictures {
    /// Returns the textures of these settings, kept or made now.
    pub(super) fn of(&self, settings: TextureSettings) -> Result<CharcoalTextures> {
        let (size, seed, random) = (settings.noise.size, settings.noise.seed, settings.noise.random);
        if size.width.max(size.height) > LARGEST_SIDE_PX {
            return Err(Error::value(
                "texture-size",
                size,
                format!("a texture has 1 to {LARGEST_SIDE_PX} pixels on each side"),
            ));
        }
        // The value behind the lock is replaced as a whole, so a panic elsewhere leaves it intact.
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((known, made)) = kept.as_ref()
            && *known == settings
        {
            return Ok(made.clone());
        }
        let [noise, cet, paper] = &settings.sources;
        let sheet = PaperTexture { size, seed, random };
        let made = CharcoalTextures {
            noise: noise.or_made(|| settings.noise.picture())?,
            cet: cet.or_made(|| settings.contrast.picture())?,
            paper: paper.or_made(|| sheet.picture())?,
            tooth: match (settings.has_tooth, paper) {
                (false, _) => None,
                (true, TextureSource::Made) => Some(Arc::new(sheet.height()?)),
                (true, TextureSource::File { picture, .. }) => Some(Arc::new(height_of(picture))),
            },
        };
        *kept = Some((settings, made.clone()));
        Ok(made)
    }
}
