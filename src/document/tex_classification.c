/* The classification as a LaTeX document. */
#include "base/memory.h"
#include "document/classification_internal.h"
#include "document/tex_internal.h"

static void section(void *to, const char *id, const char *title)
{
    (void)id;
    nh_tex_add(to, "\\section{");
    nh_tex_words(to, title);
    nh_tex_add(to, "}\n");
}

static void item(void *to, const char *title)
{
    nh_tex_add(to, "\\subsection{");
    nh_tex_words(to, title);
    nh_tex_add(to, "}\n");
}

static void words(void *to, const char *text)
{
    nh_tex_words(to, text);
    nh_tex_add(to, "\n\n");
}

static void formula(void *to, const char *label, const char *text) { nh_tex_display(to, label, text); }

static void plot(void *to, nh_plot *figure, const char *caption) { nh_tex_plot(to, figure, caption); }

void nh_tex_classification(const nh_classified *line, const nh_classified_plane *plane, nh_text *out)
{
    nh_tex_writer w = {(plane ? plane->family : line)->almost_all, out};
    nh_classification_pen pen = {&w, section, item, words, formula, plot};
    nh_text answer;
    nh_text_init(&answer);
    nh_tex_head(&w, w.r->system->title, false);
    nh_tex_add(&w, "\\begingroup\\parindent=0pt\\emergencystretch=3em\n");
    nh_classification_answer(line, plane, &answer);
    nh_tex_words(&w, nh_text_string(&answer));
    nh_tex_add(&w, "\n\n");
    nh_text_clear(&answer);
    nh_classification_outline(line, plane, &pen);
    nh_tex_system(&w);
    nh_tex_repeat(&w);
    nh_tex_add(&w, "\\par\\endgroup\n\\end{document}\n");
}
