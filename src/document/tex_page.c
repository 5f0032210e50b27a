/* The beginning and the end of every LaTeX document, and how to repeat the run. */
#include "base/versions.h"
#include "document/tex_internal.h"

static const char macros[] = "\\providecommand{\\nhnumber}[2]{$#2$} % all digits, and what is shown\n"
                             "\\providecommand{\\nhbreak}{\\penalty0\\hskip0pt\\relax}\n"
                             "\\definecolor{nhblue}{HTML}{0072B2}\\definecolor{nhred}{HTML}{D55E00}\\definecolor{"
                             "nhgreen}{HTML}{009E73}\\definecolor{nhpink}{HTML}{CC79A7}"
                             "\\definecolor{nhorange}{HTML}{E69F00}\\definecolor{nhsky}{HTML}{56B4E9}\n";

void nh_tex_head(nh_tex_writer *w, const char *what)
{
    static const char packages[] = "\\usepackage{amsmath,amssymb,longtable,pgfplots}\n";
    nh_tex_add(w, "% Written by nhsym " NH_VERSION ".\n");
    if (w->fragment)
        nh_text_addf(w->out,
                     "%% To be read by \\input; the document needs these lines before its beginning:\n%% %s%% "
                     "\\pgfplotsset{compat=1.16}\n",
                     packages);
    else
        nh_text_addf(w->out,
                     "\\documentclass[11pt,a4paper]{article}\n%s\\usepackage[margin=2.5cm]{geometry}\n\\pgfplotsset{"
                     "compat=1.16}\n",
                     packages);
    nh_tex_add(w, nh_tex_formula_macro);
    nh_tex_add(w, macros);
    if (w->fragment) return;
    nh_tex_add(w, "\\title{");
    nh_tex_words(w, w->system->title);
    if (what) nh_text_addf(w->out, ": %s", what);
    nh_tex_add(w, "}\n\\author{nhsym " NH_VERSION "}\n\\date{}\n\\begin{document}\n\\maketitle\n");
}

void nh_tex_repeat(nh_tex_writer *w, const nh_run *run)
{
    nh_tex_add(w, "\\section{To repeat it}\n\\begin{raggedright}\n");
    if (run->command) nh_tex_code(w, run->command), nh_tex_add(w, "\n\n");
    nh_tex_add(w, "nhsym " NH_VERSION ", seed ");
    nh_tex_number(w, run->seed, 17);
    if (run->system_path) nh_tex_add(w, ", system file "), nh_tex_code(w, run->system_path);
    if (run->analysis_path) nh_tex_add(w, ", analysis file "), nh_tex_code(w, run->analysis_path);
    for (size_t i = 0; nh_version_of(i).name; i++) {
        nh_tex_add(w, ", ");
        nh_tex_words(w, nh_version_of(i).name);
        nh_tex_add(w, " ");
        nh_tex_words(w, nh_version_of(i).version);
    }
    nh_tex_add(w, ", ");
    nh_tex_words(w, nh_versions_machine());
    nh_tex_add(w, ".\n\n\\end{raggedright}\n");
}
