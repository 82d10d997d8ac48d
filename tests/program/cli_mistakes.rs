//! Typing mistakes, each with its whole error: exit code 2, empty standard output, no file left.

use crate::support::names;
use std::process::{Command, Stdio};
use tinta::lines::DrawingFormat;
use tinta::mesh::Format;

/// Files in the folder where the commands are typed.
const FILES: [(&str, &str); 16] = [
    ("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    ("twice.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\n"),
    ("curve.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n"),
    ("empty.obj", ""),
    ("cut.obj", "v 0 0 0\nv 1 0 0\nv 0 1"),
    ("points.obj", "v 0 0 0\nv 1 0 0\n"),
    ("notes.txt", "dear diary\n"),
    ("damaged.ply", "not ply"),
    (
        "strips.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\nproperty int length\nend_header\n0 0 0\n3\n",
    ),
    ("cut.stl", "solid a\nfacet normal 0 0 1\n"),
    ("old.gltf", "{\"asset\": {\"version\": \"1.0\"}, \"meshes\": {\"a\": {}}}"),
    ("draco.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"extensionsRequired\": [\"KHR_draco_mesh_compression\"]}"),
    ("unknown.toml", "style = \"ink\"\ncolour = \"red\"\n"),
    ("value.toml", "style = \"inkng\"\n"),
    ("jobs.jsonl", "{\"id\": \"a\"}\n"),
    ("typo.jsonl", "{\"id\": \"a\", \"command\": \"render\", \"model\": \"-\", \"output\": \"a.png\"}\n"),
];

/// Command lines and their errors.
const MISTAKES: [(&str, &str); 122] = [
    ("redner", "there is no command redner; did you mean render?"),
    ("render", "a model and --output are missing: tinta render cow.obj -o cow.png; see --help"),
    ("render triangle.obj", "--output is missing; name the picture to write: -o triangle.png; see --help"),
    ("render dir/my-cow.v2.obj", "--output is missing; name the picture to write: -o my-cow.v2.png; see --help"),
    ("render triangle.obj out.png", "--output is missing; did you mean -o out.png?"),
    ("page triangle.obj", "--output is missing; name the page to write: -o triangle.html; see --help"),
    ("out.png", "out.png is no model; tinta again out.png -o FILE draws a picture of tinta's again; see --help"),
    (
        "render triangle.obj twice.obj -o %s.png",
        "%s.png: %s stands for no model's name; tinta batch draws a picture of each model: -o '{name}.png'",
    ),
    (
        "render triangle.obj -o out.png --page A4 --page A3",
        "--page: it is given twice; leave one of them out; see --help",
    ),
    (
        "render triangle.obj -o out.png --style print",
        "invalid value 'print' for '--style <STYLE>': this is a look; write --look print; see --help",
    ),
    ("render triangle.obj -o out.png --colour red", "tinta render has no option --colour; did you mean --color?"),
    ("render triangle.obj -o out.png -size 64", "tinta render has no option -size; did you mean --size?"),
    (
        "render triangle.obj -o out.png --style toon",
        "invalid value 'toon' for '--style <STYLE>': choose one of phong, three-pass, two-pass, mrt, inking, dietrich, ink, charcoal, sand, back-faces, lines; see --help",
    ),
    (
        "render triangle.obj -o out.png --style suggestive",
        "invalid value 'suggestive' for '--style <STYLE>': this style is gone; --style lines --classes silhouette,boundary,crease,suggestive draws suggestive contours; see --help",
    ),
    (
        "render triangle.obj -o out.png --valley-radius 2",
        "--valley-radius: this option is gone; --style lines --classes silhouette,boundary,crease,suggestive draws suggestive contours; see --help",
    ),
    (
        "render triangle.obj -o out.png --style three_pass",
        "invalid value 'three_pass' for '--style <STYLE>': did you mean three-pass?",
    ),
    (
        "render triangle.obj -o out.png --size 0",
        "invalid value '0' for '--size <WxH>': a size is WIDTHxHEIGHT in pixels, each at least 1, or one number for both; see --help",
    ),
    (
        "render triangle.obj -o out.png --size 10x",
        "invalid value '10x' for '--size <WxH>': a size is WIDTHxHEIGHT in pixels, each at least 1, or one number for both; see --help",
    ),
    (
        "render triangle.obj -o out.png --size",
        "a value is required for '--size <WxH>' but none was supplied; see --help",
    ),
    (
        "render triangle.obj -o out.png --color blakc",
        "invalid value 'blakc' for '--color <COLOR>': a colour is a CSS name or #rrggbb, for example tan or #d2b48c, or own; see --help",
    ),
    ("render triangle.obj -o out.png --view tpo", "invalid value 'tpo' for '--view <VIEW>': did you mean top?"),
    (
        "render triangle.obj -o out.png --view 1",
        "invalid value '1' for '--view <VIEW>': a view is iso, front, back, left, right, top, bottom or AZIMUTH,ELEVATION in degrees with the elevation from -90 to 90; see --help",
    ),
    (
        "render triangle.obj -o out.png --fov wide",
        "invalid value 'wide' for '--fov <DEGREES>': give a number; see --help",
    ),
    (
        "render triangle.obj -o out.png --fov 0",
        "--fov 0: the field of view is an angle between 0 and 180 degrees, both excluded",
    ),
    (
        "render triangle.obj -o out.png --eye 1,2",
        "invalid value '1,2' for '--eye <X,Y,Z>': give 3 numbers separated by commas, without blanks, or fitted; see --help",
    ),
    (
        "render triangle.obj -o out.png --eye 1,2,3 --view front",
        "--eye and --view: they exclude each other; leave one of them out",
    ),
    ("render triangle.obj -o out.png --tones 4", "--tones 4: there are 1, 2 or 3 tones"),
    (
        "render triangle.obj -o out.png --tones tone-levels=1,2",
        "invalid value 'tone-levels=1,2' for '--tones <N>': tone-levels: give 3 numbers separated by commas, without blanks; see --help",
    ),
    (
        "render triangle.obj -o out.png --filter sobell",
        "invalid value 'sobell' for '--filter <FILTER>': did you mean sobel?",
    ),
    (
        "render triangle.obj -o out.png --border-width 0",
        "--border-width 0: a border is 1 to 64 pixels wide, or up to 10% of the picture's height; --style inking draws wider lines",
    ),
    (
        "render triangle.obj -o out.png --style inking --classes crease,boundry",
        "invalid value 'crease,boundry' for '--classes <CLASSES>': did you mean boundary?",
    ),
    (
        "render triangle.obj -o out.png --style inking --line-width 0",
        "--line-width 0: a line's width is a number of pixels above 0 and at most 16384",
    ),
    (
        "render triangle.obj -o out.png --up-axis w",
        "invalid value 'w' for '--up-axis <AXIS>': choose one of auto, x, y, z, -x, -y, -z; see --help",
    ),
    ("render triangle.obj -o out.png --weld 2", "--weld 2: the tolerance is a share of the model's size from 0 to 0.1"),
    (
        "render triangle.obj -o out.png --normals flatt",
        "invalid value 'flatt' for '--normals <WHERE>': did you mean flat?",
    ),
    (
        "render triangle.obj -o out.svg --part=*:line-width=-3",
        "--part: line-width -3: a line's width is a number from 0.001 to 16384",
    ),
    (
        "render triangle.obj -o out.pdf --page A4,margn=1cm",
        "invalid value 'A4,margn=1cm' for '--page <PAPER>': did you mean margin?",
    ),
    (
        "render triangle.obj -o out.svg --form-lines suggestive-threshold=1",
        "invalid value 'suggestive-threshold=1' for '--form-lines <STRENGTH>': this option is gone; --form-lines has the strength of form lines, \
         in multiples of the usual; see --help",
    ),
    (
        "render triangle.obj -o out.png --section x=0 --section section-hatch=nan",
        "--section section-hatch=NaN: the spacing is a length, 0 or more",
    ),
    (
        "render triangle.obj -o out.png --normals smooth-angle=400",
        "--normals smooth-angle=400: the angle is between 0 and 180 degrees",
    ),
    (
        "render triangle.obj -o out.png --texture skin=none.png",
        "none.png: there is no such file; check the name after --texture skin",
    ),
    (
        "render triangle.obj -o out.png --turntable 0",
        "invalid value '0' for '--turntable <N>': give a whole number from 1 to 10000; see --help",
    ),
    (
        "render triangle.obj -o out.png --frames 0",
        "invalid value '0' for '--frames <N>': give a whole number from 1 to 1000000; see --help",
    ),
    (
        "render triangle.obj -o out.png --json --explain",
        "--json and --explain: they exclude each other; leave one of them out",
    ),
    (
        "render triangle.obj -o out.png --pen",
        "--pen: a picture of pixels cannot have it; leave it out, or write a .svg or .pdf",
    ),
    (
        "render triangle.obj -o out.png --style charcoal --show map",
        "--show: the style charcoal has no map, lines or tones; show final, diffuse, cem, cet or paper",
    ),
    (
        "render triangle.obj -o out.png --model-frame 1",
        "--model-frame 1: triangle.obj has no frames; leave the option out, or name an MD2 model",
    ),
    (
        "render triangle.obj -o out.png --animate",
        "out.png: this names one picture; an animation is a .gif or .apng file, or has numbered names such as frame-%04d.png",
    ),
    (
        "render triangle.obj -o out.gif",
        "out.gif: this names an animation; add --turntable 60, or --animate for a model with frames, or name one picture such as drawing.png",
    ),
    (
        "render triangle.obj -o out-%03d.svg",
        "out-%03d.svg: this names an animation; add --turntable 60, or --animate for a model with frames, or name one picture such as drawing.png",
    ),
    (
        "render triangle.obj --look print --sheet third -o out.svg",
        "--sheet: drawings of lines alone have it; leave it out, or choose --look technical or --style lines",
    ),
    (
        "render twice.obj -o out.png --strict",
        "twice.obj: 1 duplicate triangle; repair the model, or leave out --strict to draw it all the same",
    ),
    (
        "render triangle.obj -o out.xyz",
        "out.xyz: tinta writes no .xyz; use .png, .jpg, .bmp, .tga or .ppm for a picture, FILES_OF_LINES for lines, .gif or .apng for an animation",
    ),
    (
        "render triangle.obj -o out",
        "out: the name has no extension; use .png, .jpg, .bmp, .tga or .ppm for a picture, FILES_OF_LINES for lines, .gif or .apng for an animation",
    ),
    (
        "render triangle.obj -o out.svg --class-colors silhouete=red",
        "invalid value 'silhouete=red' for '--class-colors <COLORS>': did you mean silhouette?",
    ),
    (
        "render curve.obj -o out.png",
        "curve.obj: it has no faces, only curves and points; draw it with --style lines, or into a .svg",
    ),
    ("render triangle.obj -o nowhere/out.png", "nowhere/out.png: the folder nowhere does not exist; create it first"),
    ("render triangle.obj -o dir", "dir: this is a directory; name a file in it"),
    (
        "render triangle.obj -o out.svg --style phong",
        "out.svg: style phong draws pixels; --look print in its place draws areas and lines, --look technical lines, or name a picture such as drawing.png",
    ),
    (
        "render triangle.obj -o out.json --look sketch",
        "out.json: look sketch draws pixels; --look print in its place draws areas and lines, --look technical lines, or name a picture such as drawing.png",
    ),
    (
        "render triangle.obj -o out.svg --style lines --no-borders",
        "--no-borders: style lines draws nothing but lines; leave it out, or add --areas object",
    ),
    (
        "render triangle.obj -o out.svg --areas face --pen",
        "--areas: a pen draws lines alone; leave out one of --areas and --pen",
    ),
    (
        "render triangle.obj -o out.png --style lines --areas face",
        "--areas: a picture of exact lines has no areas; leave it out, or write a .svg",
    ),
    (
        "render triangle.obj -o out-%d.svg --areas object --turntable 3",
        "--turntable: areas are drawn from one view; leave it out, or draw lines alone",
    ),
    (
        "render triangle.obj -o out.pdf --look sketch --style sand",
        "out.pdf: style sand draws pixels; --look print in its place draws areas and lines, --look technical lines, or name a picture such as drawing.png",
    ),
    ("render triangle.obj -o .png", ".png: this is an ending without a name; write drawing.png"),
    ("render triangle.obj -o .svg --look technical", ".svg: this is an ending without a name; write drawing.svg"),
    ("render triangle.obj -o out/", "out/: this names a folder; name a file in it, such as out/drawing.png"),
    (
        "render triangle.obj -o out.png/",
        "out.png/: this names a folder; name a file in it, such as out.png/drawing.png",
    ),
    (
        "render triangle.obj -o out.png --page A4",
        "--page: a picture has pixels and no paper; for 300 dpi say --size 2480x3508, or write a .svg or .pdf",
    ),
    (
        "render triangle.obj -o out.png --style lines --page letter-landscape",
        "--page: a picture has pixels and no paper; for 300 dpi say --size 3300x2550, or write a .svg or .pdf",
    ),
    (
        "render triangle.obj -o out.png --page dpi=300",
        "--page dpi: a picture has pixels and no paper; say --size, or write a .svg or .pdf",
    ),
    (
        "render triangle.obj -o out.svg --class-widths outlines=3",
        "invalid value 'outlines=3' for '--class-widths <WIDTHS>': did you mean outline?",
    ),
    (
        "render triangle.obj -o out.png --preset none.toml",
        "none.toml: there is no such file; name a preset, or one that ships: paper:evangelista-three-pass, paper:evangelista-two-pass, paper:dachsbacher-inking, paper:valente-charcoal-in-part, paper:valente-sand-in-part",
    ),
    (
        "render triangle.obj -o out.png --preset paper:evangelista-tree-pass",
        "paper:evangelista-tree-pass: no shipped preset has this name; did you mean paper:evangelista-three-pass?",
    ),
    (
        "render triangle.obj -o out.png --preset unknown.toml",
        "unknown.toml: line 2: colour: there is no such option; did you mean color?",
    ),
    ("render triangle.obj -o out.png --preset value.toml", "value.toml: line 1: style inkng: did you mean inking?"),
    (
        "render triangle.obj -o out.png --backend ogl",
        "invalid value 'ogl' for '--backend <BACKEND>': did you mean egl?",
    ),
    ("render none.obj -o out.png", "none.obj: there is no such file; check the name"),
    ("render dir -o out.png", "dir: this is a directory; name a model file in it"),
    ("render empty.obj -o out.png", "empty.obj: the file is empty; export the model again"),
    ("render notes.txt -o out.png", "notes.txt: this is not a model in a supported format; use one of MODELS"),
    (
        "render cut.obj -o out.png",
        "cut.obj: line 3: a vertex is not three numbers; correct this line or export the model again",
    ),
    ("render points.obj -o out.png", "points.obj: it holds 2 vertices but no faces; export it with its faces"),
    (
        "render damaged.ply -o out.png",
        "damaged.ply: it does not begin like a PLY file; it is damaged or misnamed, export it again",
    ),
    ("render strips.ply -o out.png", "strips.ply: its triangle strips have no list of vertex_indices; export it again"),
    ("render cut.stl -o out.png", "cut.stl: it ends within a facet; it is damaged or cut off, export it again"),
    (
        "render old.gltf -o out.png",
        "old.gltf: it is glTF 1.0, and only glTF 2 is read; convert it, for instance with: gltf-pipeline -i IN.gltf -o OUT.glb",
    ),
    (
        "render draco.gltf -o out.png",
        "draco.gltf: it needs the extension KHR_draco_mesh_compression, which tinta does not read; decompress it, for instance with: gltf-transform copy IN.glb OUT.glb",
    ),
    (
        "render https://example.org/cow.obj -o out.png",
        "https://example.org/cow.obj: this is an address, and only files are read; fetch it first, for instance with: curl -L ADDRESS | tinta render - -o picture.png",
    ),
    ("render builtin:gaer -o out.png", "builtin:gaer: there is no such built-in model; did you mean builtin:gear?"),
    (
        "render builtin:cow -o out.png",
        "builtin:cow: there is no such built-in model; choose one of builtin:bust, builtin:open-box, builtin:ant, builtin:gear, builtin:car, builtin:case, builtin:plates, builtin:soldier, builtin:sphere, builtin:ellipsoid, builtin:torus, builtin:superquadric, builtin:patch",
    ),
    (
        "render - -o out.png",
        "standard input: nothing came; pipe a model file into it, or see what the command before the pipe says",
    ),
    ("info triangle.obj --seed 3", "tinta info has no option --seed; see --help"),
    ("info triangle.obj other.obj", "tinta info takes one model; other.obj is one too many; see --help"),
    ("info --crease-angle 30", "--crease-angle: it counts a model's edges; name the model; see --help"),
    ("render triangle.obj --look all -o out.png", "out.png: --look all draws a picture in each look; name a folder"),
    (
        "compare triangle.obj -o out.png --left phong",
        "--left phong: this style has no lines to compare; choose one of three-pass, two-pass, mrt, inking, dietrich, ink, back-faces, print, technical, sketch",
    ),
    ("measure triangle.obj", "--output is missing; name the folder to write into: -o results; see --help"),
    (
        "measure triangle.obj -o out --tolerance 0",
        "invalid value '0' for '--tolerance <SHARE>': it is a share of the picture's height, above 0 and at most 1/32; 1/256 are 2 pixels of 512; see --help",
    ),
    ("batch jobs.jsonl -o out", "jobs.jsonl: line 1: it has no output; name the file to write"),
    ("batch -o out", "a model is missing; name a file, or a built-in one such as builtin:bust; see --help"),
    ("batch triangle.obj", "--output is missing; name the folder to write into: -o results; see --help"),
    (
        "batch triangle.obj -o out.svg",
        "out.svg: each model is drawn into its own file; name a folder, or files such as 'pics/{name}.svg'",
    ),
    (
        "batch triangle.obj sub/triangle.stl -o out",
        "out/triangle.png: triangle.obj and sub/triangle.stl would both be drawn into it; rename one of them",
    ),
    ("batch dir -o out", "dir: this folder holds no model that tinta reads; name another"),
    (
        "batch triangle.obj notes.txt -o out",
        "notes.txt: this is no model; name models and folders of models, or one list of jobs",
    ),
    (
        "batch triangle.obj -o {name}.xyz",
        "./triangle.xyz: tinta writes no .xyz; use .png, .jpg, .bmp, .tga or .ppm for a picture, FILES_OF_LINES for lines, .gif or .apng for an animation",
    ),
    (
        "render triangle.obj twice.obj -o dir/",
        "dir/: tinta render makes one picture of all models; tinta batch in its place makes one of each",
    ),
    (
        "render triangle.obj -o {name}.svg",
        "{name}.svg: tinta render makes one picture of all models; tinta batch in its place makes one of each",
    ),
    ("triangle.png", "triangle.png is no model; did you mean triangle.obj?"),
    (
        "render triangle.obj -o out.svg --size 100mm",
        "invalid value '100mm' for '--size <WxH>': a size is in pixels, without a unit; for a size on paper write --page 100x80mm; see --help",
    ),
    ("render triangle.obj -o out.svg --section X:3", "invalid value 'X:3' for '--section <PLANE>': did you mean x=3?"),
    (
        "render triangle.obj -o out.svg --section w=3",
        "invalid value 'w=3' for '--section <PLANE>': write an axis, x, y or z, and where it is cut, such as x=12, or a normal and a number, such as 1,1,0=5; for a half-section give --section twice; see --help",
    ),
    ("batch nothing*.stl -o out", "nothing*.stl: there is no such file; check the name"),
    ("batch typo.jsonl -o out", "typo.jsonl: line 1: model: - is standard input, which jobs lack; name a file"),
    ("batch none.jsonl -o out", "none.jsonl: there is no such file; check the name"),
    ("again notes.txt", "notes.txt: this is neither PNG nor SVG, and other files carry no recipe"),
    ("again notes.txt -o out.png", "notes.txt: this is neither PNG nor SVG, and other files carry no recipe"),
    ("generate man -o triangle.obj", "-o triangle.obj: this is a file; name a folder"),
    (
        "generate nushell",
        "invalid value 'nushell' for '<WHAT>': choose one of bash, zsh, fish, powershell, man; see --help",
    ),
    ("generate bahs", "invalid value 'bahs' for '<WHAT>': did you mean bash?"),
];

#[test]
fn every_mistake_is_one_sentence_that_says_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::create_dir(folder.join("dir")).unwrap();
    FILES.iter().for_each(|(name, content)| std::fs::write(folder.join(name), content).unwrap());
    let before = names(folder);
    let mut wrong = Vec::new();
    let drawings: Vec<String> = DrawingFormat::ALL.iter().map(|format| format!(".{}", format.ending)).collect();
    for (line, sentence) in MISTAKES {
        let sentence = sentence.replace("FILES_OF_LINES", &drawings.join(", "));
        let sentence = sentence.replace("MODELS", &Format::names().join(", "));
        let mut command = Command::new(env!("CARGO_BIN_EXE_tinta"));
        let output = command.args(line.split(' ')).current_dir(folder).stdin(Stdio::null()).output().unwrap();
        let (said, code) = (String::from_utf8_lossy(&output.stderr), output.status.code());
        if said != format!("tinta: {sentence}\n") || code != Some(2) || !output.stdout.is_empty() {
            wrong.push(format!("tinta {line}\n  should say: {sentence}\n  but says:   {said}  with {code:?}"));
        }
        assert_eq!(names(folder), before, "tinta {line} left a file");
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
    for (name, content) in FILES {
        assert_eq!(std::fs::read_to_string(folder.join(name)).unwrap(), content, "{name} was changed");
    }
}
