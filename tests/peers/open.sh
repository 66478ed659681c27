#!/bin/sh
# SPDX-License-Identifier: MIT
# Opens a GLB in what others read it with: the glTF validator, three.js in Chromium, Blender; OBJ and PLY in Blender. Needs node and npm, chromium,
# blender with python3-numpy; what is not there is left out. Pictures lie in FOLDER, look at them.
#
#     sh tests/peers/open.sh FOLDER room.glb room.obj room.ply
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=$1
shift
mkdir -p "$folder"
if command -v npm >/dev/null && [ ! -d "$folder/node_modules/three" ]; then
    (cd "$folder" && npm install --silent --no-audit --no-fund gltf-validator three@0.160 esbuild >/dev/null)
fi
for file in "$@"; do
    echo "== $file"
    name=$(basename "$file")
    if command -v npm >/dev/null && [ "${name##*.}" = glb ]; then
        NODE_PATH="$folder/node_modules" node -e '
            const fs = require("fs"), validator = require("gltf-validator");
            validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1]))).then(r => {
              console.log("validator:", r.issues.numErrors, "errors,", r.issues.numWarnings, "warnings,", r.info.totalTriangleCount, "triangles");
              r.issues.messages.slice(0, 5).forEach(m => console.log("  " + m.pointer + " " + m.message));
            });' "$file"
        cp "$here/three.js" "$folder/three_view.mjs"
        "$folder/node_modules/.bin/esbuild" "$folder/three_view.mjs" --bundle --log-level=error --outfile="$folder/three_view.js"
        {
            printf '<!DOCTYPE html><html><body><script>window.GLB="'
            base64 -w0 "$file"
            printf '"</script><script>'
            cat "$folder/three_view.js"
            printf '</script></body></html>'
        } >"$folder/$name.html"
        if command -v chromium >/dev/null; then
            flags="--headless --no-sandbox --disable-gpu --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader --window-size=800,600 --virtual-time-budget=20000"
            # shellcheck disable=SC2086
            chromium $flags --screenshot="$folder/$name.three.png" "file://$(realpath "$folder")/$name.html" 2>/dev/null
            # shellcheck disable=SC2086
            chromium $flags --dump-dom "file://$(realpath "$folder")/$name.html" 2>/dev/null | grep -o '<title>[^<]*' | sed 's/<title>/three.js: /'
        fi
    fi
    if command -v blender >/dev/null; then
        blender --background --factory-startup --python "$here/blender.py" -- "$file" "$folder/$name.blender.png" 2>&1 | grep -E '^(mesh|bounds|cameras|.*Error)' || true
    fi
done
