//! libassimp 5 through its C interface, loaded at run time: a file in memory to lists of plain numbers.
//!
//! The structures are those of the library's headers of version 5 (`scene.h`, `mesh.h`, `cfileio.h`), up to the last field
//! that is read here; another version, or one built for doubles, is refused before any of them is touched. All files are
//! opened by [`Files`], which reads what the model's folder holds and nothing else.

#![expect(unsafe_code, reason = "libassimp is a C interface; this module wraps all of it")]

use super::imported::{Imported, ImportedMaterial, ImportedMesh, ImportedNode};
use crate::limits::MODEL_BYTES;
use crate::mesh::folder::Folder;
use libloading::{Library, Symbol};
use std::ffi::{CStr, CString, c_char, c_void};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::{ptr, slice};

/// Names of the library, on Linux and elsewhere; those of other versions are looked for so that they can be named.
const LIBRARIES: [&str; 4] = ["libassimp.so.5", "libassimp.5.dylib", "libassimp.so.6", "libassimp.so"];
/// The version whose structures these are.
const MAJOR: u32 = 5;
/// ASSIMP_CFLAGS_DOUBLE_SUPPORT: its numbers are then twice as long.
const DOUBLES: u32 = 0x20;
/// aiProcess_ValidateDataStructure: indices within their arrays, pointers where there should be any.
const VALIDATE: u32 = 0x400;
const TEXTURE_TYPE_DIFFUSE: u32 = 1;
const TEXTURE_TYPE_BASE_COLOR: u32 = 12;
const SUCCESS: i32 = 0;
const FAILURE: i32 = -1;

#[repr(C)]
struct AiString {
    length: u32,
    data: [u8; 1024],
}

#[repr(C)]
struct AiScene {
    flags: u32,
    root: *const AiNode,
    mesh_count: u32,
    meshes: *const *const AiMesh,
    material_count: u32,
    materials: *const *const c_void,
    animation_count: u32,
}

#[repr(C)]
struct AiNode {
    name: AiString,
    matrix: [f32; 16],
    parent: *const AiNode,
    child_count: u32,
    children: *const *const AiNode,
    mesh_count: u32,
    meshes: *const u32,
}

#[repr(C)]
struct AiMesh {
    primitive_types: u32,
    vertex_count: u32,
    face_count: u32,
    vertices: *const [f32; 3],
    normals: *const [f32; 3],
    tangents: *const [f32; 3],
    bitangents: *const [f32; 3],
    colors: [*const [f32; 4]; 8],
    texture_coordinates: [*const [f32; 3]; 8],
    components: [u32; 8],
    faces: *const AiFace,
    bone_count: u32,
    bones: *const c_void,
    material: u32,
}

#[repr(C)]
struct AiFace {
    count: u32,
    indices: *const u32,
}

/// A file as the library asks for it; what follows `data` is ours.
#[repr(C)]
struct AiFile {
    read: extern "C" fn(*mut AiFile, *mut u8, usize, usize) -> usize,
    write: extern "C" fn(*mut AiFile, *const u8, usize, usize) -> usize,
    tell: extern "C" fn(*mut AiFile) -> usize,
    size: extern "C" fn(*mut AiFile) -> usize,
    seek: extern "C" fn(*mut AiFile, usize, i32) -> i32,
    flush: extern "C" fn(*mut AiFile),
    data: *mut c_void,
    bytes: Vec<u8>,
    position: usize,
}

#[repr(C)]
struct AiFileIo {
    open: extern "C" fn(*mut AiFileIo, *const c_char, *const c_char) -> *mut AiFile,
    close: extern "C" fn(*mut AiFileIo, *mut AiFile),
    /// A [`Files`].
    data: *mut c_void,
}

/// The functions of the library used here.
struct Functions {
    import: unsafe extern "C" fn(*const c_char, u32, *mut AiFileIo) -> *const AiScene,
    release: unsafe extern "C" fn(*const AiScene),
    error: unsafe extern "C" fn() -> *const c_char,
    color: unsafe extern "C" fn(*const c_void, *const c_char, u32, u32, *mut [f32; 4]) -> i32,
    string: unsafe extern "C" fn(*const c_void, *const c_char, u32, u32, *mut AiString) -> i32,
}

/// The library, loaded once and never unloaded.
fn functions() -> Result<&'static Functions, String> {
    static FUNCTIONS: OnceLock<Result<Functions, String>> = OnceLock::new();
    FUNCTIONS.get_or_init(|| load(&LIBRARIES)).as_ref().map_err(Clone::clone)
}

/// The first library of these names; the error says why there is none.
fn load(names: &[&str]) -> Result<Functions, String> {
    let mut reasons = Vec::new();
    for name in names {
        // SAFETY: loading the library runs its initialisers, which have no preconditions.
        match unsafe { Library::new(name) } {
            // It stays for the life of the process.
            Ok(library) => return find_functions(Box::leak(Box::new(library))),
            Err(error) => reasons.push(error.to_string()),
        }
    }
    Err(format!(
        "which is not installed ({})",
        reasons.first().map_or("its name on this system is unknown", String::as_str)
    ))
}

fn find_functions(library: &'static Library) -> Result<Functions, String> {
    let missing = |error: libloading::Error| format!("but the installed one lacks a function ({error})");
    // SAFETY: the symbols are those of the library's cimport.h, version.h and material.h, of the types given there.
    unsafe {
        let number: Symbol<'_, unsafe extern "C" fn() -> u32> = library.get(b"aiGetVersionMajor\0").map_err(missing)?;
        let major = number();
        if major != MAJOR {
            return Err(format!("but only version {MAJOR} is supported and version {major} is installed"));
        }
        let number: Symbol<'_, unsafe extern "C" fn() -> u32> = library.get(b"aiGetCompileFlags\0").map_err(missing)?;
        if number() & DOUBLES != 0 {
            return Err("but the installed one is built for doubles, which is not supported".to_owned());
        }
        Ok(Functions {
            import: *library.get(b"aiImportFileEx\0").map_err(missing)?,
            release: *library.get(b"aiReleaseImport\0").map_err(missing)?,
            error: *library.get(b"aiGetErrorString\0").map_err(missing)?,
            color: *library.get(b"aiGetMaterialColor\0").map_err(missing)?,
            string: *library.get(b"aiGetMaterialString\0").map_err(missing)?,
        })
    }
}

/// Whether there is a library that is understood; if not why, as the end of a sentence.
pub(super) fn check() -> Result<(), String> {
    functions().map(|_| ())
}

/// The files that the library may open: the model, and what its folder holds.
pub(super) struct Files<'a> {
    folder: &'a Folder<'a>,
    name: String,
    model: &'a [u8],
    /// Those it opened besides the model.
    pub opened: Vec<PathBuf>,
    /// The names of those that lie outside the folder.
    pub outside: Vec<String>,
    bytes: u64,
}

impl<'a> Files<'a> {
    /// `name` is the model's, without folders.
    pub(super) fn new(model: &'a [u8], name: String, folder: &'a Folder<'a>) -> Self {
        Self { folder, name, model, opened: Vec::new(), outside: Vec::new(), bytes: 0 }
    }

    /// Bytes of the files opened besides the model.
    pub(super) fn bytes_beside(&self) -> usize {
        self.bytes as usize
    }

    fn open(&mut self, name: &str) -> Option<Vec<u8>> {
        if name == self.name {
            return Some(self.model.to_vec());
        }
        let name = name.replace('\\', "/");
        let room = MODEL_BYTES.saturating_sub(self.bytes);
        let bytes = match self.folder.is_some().then(|| self.folder.read(Path::new(&name), room))? {
            Ok(bytes) => bytes,
            Err(crate::files::Failure::Outside) => {
                self.outside.push(name);
                return None;
            }
            Err(_) => return None,
        };
        self.bytes += bytes.len() as u64;
        self.opened.extend(self.folder.place_of(&name));
        Some(bytes.into_owned())
    }
}

/// Reads a file; the error is what the library says, or why there is none.
pub(super) fn import(files: &mut Files<'_>) -> Result<Imported, String> {
    /// The library keeps the last error for all threads together.
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    let functions = functions()?;
    let name = CString::new(files.name.as_str()).map_err(|_| "its name holds a zero byte".to_owned())?;
    let _guard = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    let mut io = AiFileIo { open, close, data: ptr::from_mut(files).cast() };
    // SAFETY: the name ends with 0; `io` and the files behind it outlive the call, which is the only one that uses them.
    let scene = unsafe { (functions.import)(name.as_ptr(), VALIDATE, &raw mut io) };
    if scene.is_null() {
        // SAFETY: a text that ends with 0 and stays until the next import, which waits for the guard.
        let error = unsafe { CStr::from_ptr((functions.error)()) };
        return Err(error.to_string_lossy().into_owned());
    }
    // SAFETY: the scene was just made by the library, of the version whose structures these are, and checked by it.
    let imported = unsafe { imported(&*scene, functions) };
    // SAFETY: it came from this library, and nothing of it is kept.
    unsafe { (functions.release)(scene) };
    Ok(imported)
}

/// A list of the library's; empty where its pointer is null.
///
/// # Safety
///
/// The pointer is null or points to `count` values that live as long as the scene they belong to.
unsafe fn list<'a, T>(pointer: *const T, count: u32) -> &'a [T] {
    if pointer.is_null() {
        return &[];
    }
    // SAFETY: as promised to this function.
    unsafe { slice::from_raw_parts(pointer, count as usize) }
}

/// # Safety
///
/// The scene is the library's, of this version, and alive.
unsafe fn imported(scene: &AiScene, functions: &Functions) -> Imported {
    // SAFETY: the library's lists have as many members as it says, none of them null once it has checked the scene.
    unsafe {
        let pointers =
            |pointer: *const *const AiMesh, count| list(pointer, count).iter().filter_map(|mesh| mesh.as_ref());
        let materials = list(scene.materials, scene.material_count).iter().filter(|material| !material.is_null());
        Imported {
            meshes: pointers(scene.meshes, scene.mesh_count).map(|mesh| imported_mesh(mesh)).collect(),
            nodes: imported_nodes(scene.root),
            materials: materials.map(|material| imported_material(*material, functions)).collect(),
            animations: scene.animation_count as usize,
        }
    }
}

/// # Safety
///
/// As for [`imported`], of a mesh of its scene.
unsafe fn imported_mesh(mesh: &AiMesh) -> ImportedMesh {
    // SAFETY: these lists have as many members as there are vertices or faces, or are not there.
    unsafe {
        let faces = list(mesh.faces, mesh.face_count);
        let corners = faces.iter().map(|face| list(face.indices, face.count));
        ImportedMesh {
            positions: list(mesh.vertices, mesh.vertex_count).to_vec(),
            normals: list(mesh.normals, mesh.vertex_count).to_vec(),
            texture_coordinates: list(mesh.texture_coordinates[0], mesh.vertex_count).to_vec(),
            indices: corners.clone().flatten().copied().collect(),
            sizes: corners.map(|corners| corners.len() as u32).collect(),
            material: mesh.material,
            has_colors: !mesh.colors[0].is_null(),
        }
    }
}

/// # Safety
///
/// As for [`imported`], of its scene's root.
unsafe fn imported_nodes(root: *const AiNode) -> Vec<ImportedNode> {
    let mut nodes = Vec::new();
    let mut waiting = vec![(root, None)];
    while let Some((node, parent)) = waiting.pop() {
        // SAFETY: a node of the scene's tree, which the library has checked, or null.
        let Some(node) = (unsafe { node.as_ref() }) else { continue };
        let place = nodes.len();
        // SAFETY: as long as the node says.
        let (meshes, children) = unsafe { (list(node.meshes, node.mesh_count), list(node.children, node.child_count)) };
        nodes.push(ImportedNode { parent, matrix: node.matrix, meshes: meshes.to_vec() });
        waiting.extend(children.iter().rev().map(|child| (*child, Some(place))));
    }
    nodes
}

/// # Safety
///
/// As for [`imported`], of a material of its scene.
unsafe fn imported_material(material: *const c_void, functions: &Functions) -> ImportedMaterial {
    let text = |key: &CStr, kind| {
        let mut text = AiString { length: 0, data: [0; 1024] };
        // SAFETY: the material is alive, the key ends with 0, and the text has room for the library's longest.
        let found = unsafe { (functions.string)(material, key.as_ptr(), kind, 0, &raw mut text) };
        let bytes = text.data.get(..text.length as usize).unwrap_or_default();
        (found == SUCCESS && !bytes.is_empty()).then(|| String::from_utf8_lossy(bytes).into_owned())
    };
    let mut color = [0.0; 4];
    // SAFETY: as above; four numbers are what the library writes.
    let found = unsafe { (functions.color)(material, c"$clr.diffuse".as_ptr(), 0, 0, &raw mut color) };
    let [red, green, blue, _] = color;
    ImportedMaterial {
        name: text(c"?mat.name", 0).unwrap_or_default(),
        color: (found == SUCCESS).then_some([red, green, blue]),
        texture: text(c"$tex.file", TEXTURE_TYPE_DIFFUSE).or_else(|| text(c"$tex.file", TEXTURE_TYPE_BASE_COLOR)),
    }
}

extern "C" fn open(io: *mut AiFileIo, name: *const c_char, mode: *const c_char) -> *mut AiFile {
    // SAFETY: the library hands back what `import` gave it, and texts that end with 0.
    let (files, name, mode) =
        unsafe { (&mut *(*io).data.cast::<Files<'_>>(), CStr::from_ptr(name), CStr::from_ptr(mode)) };
    let bytes = match (mode.to_bytes().starts_with(b"r"), name.to_str()) {
        (true, Ok(name)) => files.open(name),
        _ => None,
    };
    bytes.map_or(ptr::null_mut(), |bytes| {
        let data = ptr::null_mut();
        Box::into_raw(Box::new(AiFile { read, write, tell, size, seek, flush, data, bytes, position: 0 }))
    })
}

extern "C" fn close(_: *mut AiFileIo, file: *mut AiFile) {
    if !file.is_null() {
        // SAFETY: `open` made it, and the library closes a file once.
        drop(unsafe { Box::from_raw(file) });
    }
}

/// As C's `fread`: so many whole records of a size.
extern "C" fn read(file: *mut AiFile, to: *mut u8, record: usize, count: usize) -> usize {
    // SAFETY: `open` made it, and it is not closed yet; so in all of these.
    let file = unsafe { &mut *file };
    let rest = file.bytes.get(file.position..).unwrap_or_default();
    let count = rest.len().checked_div(record).unwrap_or_default().min(count);
    // SAFETY: the library has room for the records it asks for, which are these or more.
    unsafe { ptr::copy_nonoverlapping(rest.as_ptr(), to, count * record) };
    file.position += count * record;
    count
}

extern "C" fn write(_: *mut AiFile, _: *const u8, _: usize, _: usize) -> usize {
    0
}

extern "C" fn tell(file: *mut AiFile) -> usize {
    // SAFETY: as in `read`.
    unsafe { (*file).position }
}

extern "C" fn size(file: *mut AiFile) -> usize {
    // SAFETY: as in `read`.
    let file = unsafe { &*file };
    file.bytes.len()
}

/// As C's `fseek`: an offset below zero comes as a number beyond all others.
extern "C" fn seek(file: *mut AiFile, offset: usize, origin: i32) -> i32 {
    // SAFETY: as in `read`.
    let file = unsafe { &mut *file };
    let from = match origin {
        0 => 0,
        1 => file.position,
        2 => file.bytes.len(),
        _ => return FAILURE,
    };
    let position = from.wrapping_add(offset);
    if position > file.bytes.len() {
        return FAILURE;
    }
    file.position = position;
    SUCCESS
}

extern "C" fn flush(_: *mut AiFile) {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_library_that_is_not_there_or_is_another_is_a_reason() {
        let reason = |names: &[&str]| load(names).map(|_| ()).unwrap_err();
        assert!(reason(&["libno-such-library.so.5"]).starts_with("which is not installed (libno-such-library.so.5"));
        // The C library is there and has no models in it.
        if cfg!(target_os = "linux") {
            assert!(reason(&["libc.so.6"]).starts_with("but the installed one lacks a function"));
        }
    }

    #[test]
    fn a_file_is_read_and_sought_as_the_c_library_does() {
        let folder = Folder::of_files(&[]);
        let mut files = Files::new(b"0123456789", "a.x".to_owned(), &folder);
        let mut io = AiFileIo { open, close, data: ptr::from_mut(&mut files).cast() };
        assert!(open(&raw mut io, c"a.x".as_ptr(), c"wb".as_ptr()).is_null(), "nothing is written");
        assert!(open(&raw mut io, c"/etc/hostname".as_ptr(), c"rb".as_ptr()).is_null(), "nothing else is read");
        let file = open(&raw mut io, c"a.x".as_ptr(), c"rb".as_ptr());
        let mut buffer = [0; 16];
        assert_eq!((size(file), read(file, buffer.as_mut_ptr(), 4, 3), tell(file)), (10, 2, 8));
        assert_eq!(&buffer[..9], b"01234567\0");
        assert_eq!((seek(file, 3usize.wrapping_neg(), 2), tell(file)), (SUCCESS, 7));
        assert_eq!((seek(file, 2usize.wrapping_neg(), 1), tell(file)), (SUCCESS, 5));
        assert_eq!((seek(file, 11, 0), seek(file, 1, 7), tell(file)), (FAILURE, FAILURE, 5));
        assert_eq!(read(file, buffer.as_mut_ptr(), 0, 5), 0);
        close(&raw mut io, file);
    }
}
