//! Known driver faults and their workarounds. Each was observed with tinta.

use crate::gl::ContextInfo;
use serde::Serialize;

/// A fault of a driver.
#[derive(Debug, Clone, Serialize)]
pub struct KnownFault {
    /// In a few words.
    pub name: &'static str,
    /// The first version it was seen in.
    pub first_seen: &'static str,
    /// The last version with the fault; untested versions may have it too.
    pub last_seen: &'static str,
    /// tinta's workaround.
    pub workaround: &'static str,
    /// How tinta knows that the driver has it.
    pub detected_by: &'static str,
    /// Whether a context is of such a driver.
    #[serde(skip)]
    pub is_of: fn(&ContextInfo) -> bool,
}

/// All that are known.
pub(crate) const KNOWN: [KnownFault; 7] = [
    KnownFault {
        name: "two contexts of one screen crash when they work at once",
        first_seen: "Mesa 22.3.6, llvmpipe",
        last_seen: "Mesa 22.3.6, llvmpipe",
        workaround: "contexts of one software screen take turns; a second thread draws on its own screen",
        detected_by: "the renderer's name: every software driver counts as one",
        is_of: |info| info.renderer.starts_with("llvmpipe"),
    },
    KnownFault {
        name: "surfaces of earlier sizes are kept",
        first_seen: "Mesa 22.3.6, OSMesa",
        last_seen: "Mesa 22.3.6, OSMesa",
        workaround: "a surface's record is kept from lying where the last one lay",
        detected_by: "the backend",
        is_of: |info| info.backend == "osmesa",
    },
    KnownFault {
        name: "an unknown GALLIUM_DRIVER crashes it",
        first_seen: "Mesa 22.3.6, OSMesa",
        last_seen: "Mesa 22.3.6, OSMesa",
        workaround: "tinta refuses it with an error before it calls the library",
        detected_by: "the backend, and the variable",
        is_of: |info| info.backend == "osmesa",
    },
    KnownFault {
        name: "published charcoal and sand change shade",
        first_seen: "Mesa 20.3.5, llvmpipe",
        last_seen: "NVIDIA 580.159.04, H100",
        workaround: "none; less so with texture-size as large as the picture",
        detected_by: "the renderer's name and version, and the vendor",
        is_of: |info| {
            info.renderer.contains("softpipe")
                || info.version.contains("Mesa 20.3")
                || info.vendor.starts_with("NVIDIA")
        },
    },
    KnownFault {
        name: "smoothed lines shade the pixels of their sides otherwise",
        first_seen: "NVIDIA 580.159.04, H100",
        last_seen: "NVIDIA 580.159.04, H100",
        workaround: "none, as OpenGL leaves the shade to the driver; line-drawing quads draws as the reference driver does",
        detected_by: "the vendor",
        is_of: |info| info.vendor.starts_with("NVIDIA"),
    },
    KnownFault {
        name: "the points that join wide lines cover other pixels",
        first_seen: "Mesa 22.3.6, zink on lavapipe",
        last_seen: "Mesa 22.3.6, zink on lavapipe",
        workaround: "none; the style inking with joints off draws as the reference driver does",
        detected_by: "the renderer's name",
        is_of: |info| info.renderer.starts_with("zink"),
    },
    KnownFault {
        name: "EGL's display opens only when software rendering is requested",
        first_seen: "Mesa 22.3.6, zink on lavapipe",
        last_seen: "Mesa 22.3.6, zink on lavapipe",
        workaround: "set LIBGL_ALWAYS_SOFTWARE=1 beside GALLIUM_DRIVER=zink",
        detected_by: "the renderer's name",
        is_of: |info| info.renderer.starts_with("zink"),
    },
];
