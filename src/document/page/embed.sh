#!/bin/sh
# embed.sh FOLDER: the files of a page as strings of C (document/page.h); scripts and style without comment lines and indentation.
#
# font.woff2 is a part of TeX Gyre Pagella Math 1.632 by the GUST e-foundry (GUST Font License, which is the LaTeX Project Public License): the letters and
# signs of src/document/typeset.c.  Made by Debian's fonttools from fonts-texgyre-math:
#   pyftsubset texgyrepagella-math.otf --flavor=woff2 --layout-features= --no-hinting --desubroutinize --name-IDs= --unicodes=20-7e,a8,ac,b1,b7,d7,2d9,391-3a9,3b1-3c9,3d1,3d5,3d6,3f0,3f1,3f5,2026,2032,2033,2061,2062,210e,2113,2190-2192,2202,2207,2212,221a,221e,2248,2260,2264,2265,22c5,1d434-1d467,1d6e2-1d71b
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
