#!/bin/sh
# embed.sh FOLDER: the files of a page as strings of C (document/page.h); scripts and style without comment lines and indentation.
set -eu
cd "$1"
LC_ALL=C
export LC_ALL
string() { # NAME: a string from the standard input
    printf 'const char nh_page_%s[] = ""\n' "$1"
    od -An -v -to1 | sed 's/^ */"/; s/ *$/"/; s/"\([0-7]\)/"\\\1/; s/ /\\/g'
    printf ';\n'
}
text() { sed 's/^[ \t]*//; /^\/\//d; /^$/d' "$2" | string "$1"; }
echo '#include "document/page.h"'
text style page.css
string solver <solver.js
string special <special.js
text scene scene.js
text script page.js
base64 font.woff2 | tr -d '\n' | string font
