# The manual page nhsym(3) from nhsym.h: comments become text, declarations stay as they are.
# usage: awk -v version=0.1.0 -f man.awk nhsym.h
function roff(text) {
    gsub(/\\/, "\\e", text)
    gsub(/-/, "\\-", text)
    if (text ~ /^[.']/) text = "\\&" text
    return text
}

function begin_code() { if (!code) print ".PP\n.in +2n\n.nf"; code = 1 }
function end_code() { if (code) print ".fi\n.in"; code = 0 }

# One line of a comment: four blanks more than usual make a line of the example.
function say(text) {
    if (text ~ /^    /) {
        begin_code()
        sub(/^    /, "", text)
        print roff(text)
        return
    }
    end_code()
    sub(/^ +/, "", text)
    gsub(/  +/, " ", text)
    print text == "" ? ".PP" : roff(text)
}

BEGIN {
    printf ".TH NHSYM 3 \"\" \"nhsym %s\" \"Library Functions\"\n.SH NAME\nnhsym \\- symmetries and conservation laws of mechanical systems with constraints\n", version
    print ".SH SYNOPSIS\n.nf\n#include <nhsym.h>\n\ncc program.c $(pkg\\-config \\-\\-cflags \\-\\-libs nhsym)\n.fi\n.SH DESCRIPTION"
}

/^#/ || /^extern "C"/ { next }
FNR > 1 && /^}$/ { next }

# ---- section ----
/^\/\* ---- .* ---- \*\/$/ {
    end_code()
    sub(/^\/\* -+ /, "")
    sub(/ -+ \*\/$/, "")
    print ".SH " roff(toupper($0))
    next
}

# a comment that begins a line; its end may be on another
/^\/\*/ {
    comment = 1
    end_code()
    print ".PP"
    sub(/^\/\* ?/, "")
    if (FNR == 1) sub(/^nhsym: [^.]*\.$/, "")
}

comment {
    last = /\*\/$/
    sub(/ *\*\/$/, "")
    sub(/^ \* ?/, "")
    if ($0 != "" || !last) say($0)
    if (last) comment = 0
    next
}

/^$/ { end_code(); next }
{
    sub(/^NH_API /, "")
    begin_code()
    print roff($0)
}

END {
    end_code()
    print ".SH EXAMPLE\n.I example.c\nin the folder of the documentation prints the currents of a system.\n.SH SEE ALSO\n.BR nhsym (1)"
}
