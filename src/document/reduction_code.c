/* reduction_code: the reduced equations as C and as LaTeX. */
#include <string.h>

#include "base/escape.h"
#include "base/memory.h"
#include "graph/print.h"
#include "document/typeset.h"
#include "document/typeset_code.h"
#include "document/reduction.h"
#include "document/tex_internal.h"

static const char c_head[] =
    "#include <math.h>\n"
    "\n"
    "/* Solves M w = p for a symmetric positive definite M (r x r, row by row; overwritten); p becomes w.  0, or -1 where M is singular. */\n"
    "static int nh_solve_mass(int r, double *M, double *p)\n"
    "{\n"
    "    for (int j = 0; j < r; j++) {\n"
    "        for (int k = 0; k < j; k++) M[j*r + j] -= M[j*r + k]*M[j*r + k];\n"
    "        if (!(M[j*r + j] > 0)) return -1;\n"
    "        M[j*r + j] = sqrt(M[j*r + j]);\n"
    "        for (int i = j + 1; i < r; i++) {\n"
    "            for (int k = 0; k < j; k++) M[i*r + j] -= M[i*r + k]*M[j*r + k];\n"
    "            M[i*r + j] /= M[j*r + j];\n"
    "        }\n"
    "    }\n"
    "    for (int i = 0; i < r; i++) {\n"
    "        for (int k = 0; k < i; k++) p[i] -= M[i*r + k]*p[k];\n"
    "        p[i] /= M[i*r + i];\n"
    "    }\n"
    "    for (int i = r - 1; i >= 0; i--) {\n"
    "        for (int k = i + 1; k < r; k++) p[i] -= M[k*r + i]*p[k];\n"
    "        p[i] /= M[i*r + i];\n"
    "    }\n"
    "    return 0;\n"
    "}\n";

static void put_unpacked(nh_text *out, nh_dag *d, size_t n, const nh_ex *symbol, const char *array, size_t from)
{
    for (size_t i = 0; i < n; i++) {
        nh_text_add(out, "    const double ");
        nh_typeset_c_name(nh_name_of(d, symbol[i]), out);
        nh_text_addf(out, " = %s[%zu];\n", array, from + i);
        nh_text_add(out, "    (void)");
        nh_typeset_c_name(nh_name_of(d, symbol[i]), out);
        nh_text_add(out, ";\n");
    }
}

static const char *const *targets(nh_arena *arena, const char *array, size_t n)
{
    const char **out = nh_arena_alloc(arena, (n + 1) * sizeof *out);
    for (size_t i = 0; i < n; i++) out[i] = nh_arena_printf(arena, "%s[%zu]", array, i);
    return out;
}

static void put_names(nh_text *out, const nh_reduction *r, const nh_reduced *o)
{
    for (size_t i = 0; i < o->n; i++) nh_text_addf(out, "%s, ", nh_name_of(r->kinetic->dag, o->x[i]));
    for (size_t i = 0; i < o->r; i++) nh_text_addf(out, "%s%s", o->momentum[i], i + 1 < o->r ? ", " : "");
}

/* The velocities from the momenta, or as they are. */
static void put_velocities(const nh_reduced *o, nh_dag *d, nh_arena *arena, size_t *temporaries, nh_text *out)
{
    size_t w = o->r;
    if (o->plain) {
        put_unpacked(out, d, w, o->w, "state_", o->n);
        return;
    }
    nh_text_addf(out, "    double mass_[%zu], w_[%zu];\n", w * w, w);
    nh_typeset_c(d, w * w, o->M, targets(arena, "mass_", w * w), temporaries, out);
    nh_text_addf(out, "    for (int i_ = 0; i_ < %zu; i_++) w_[i_] = state_[%zu + i_];\n    if (nh_solve_mass(%zu, mass_, w_)) return -1;\n", w, o->n, w);
    put_unpacked(out, d, w, o->w, "w_", 0);
}

static void put_stage_name(const nh_reduction *r, size_t i, const char *before, nh_text *out)
{
    const nh_reduction_stage *s = &r->stage[i];
    const char *holds = nh_reduction_stage_holds(r, s);
    nh_text_addf(out, "%s%s (%s), by %s%s%s%s", before, nh_reduction_stage_title(r, i), nh_stage_kind_name(s->kind), s->group, s->local ? ", which acts locally" : "",
                 *holds ? ", a group of symmetries" : "", holds);
}

static void put_stage(const nh_reduction *r, const nh_reduction_stage *s, size_t number, nh_text *out)
{
    const nh_reduced *o = s->shown;
    nh_dag *d = r->kinetic->dag;
    nh_arena *arena = r->kinetic->arena;
    size_t n = o->n, w = o->r, temporaries = 0, total = n + w;
    put_stage_name(r, number - 1, "\n/* ", out);
    nh_text_add(out, ".  state_ = (");
    put_names(out, r, o);
    nh_text_addf(out, "): %zu values;\n * rate_: their derivatives; zeta_: the %zu components of the group's body velocity.  0, or -1 where the mass matrix is singular. */\n", total, o->d);
    nh_text_addf(out, "int stage%zu(%sconst double *state_, double *rate_, double *zeta_)\n{\n", number, o->timed ? "double t, " : "");
    for (size_t i = 0; i < r->system->parameters; i++) {
        char text[40];
        nh_text_number(r->system->parameter[i].value, text, sizeof text);
        nh_text_add(out, "    const double ");
        nh_typeset_c_name(r->system->parameter[i].name, out);
        nh_text_addf(out, " = %s;\n    (void)", text);
        nh_typeset_c_name(r->system->parameter[i].name, out);
        nh_text_add(out, ";\n");
    }
    put_unpacked(out, d, n, o->x, "state_", 0);
    put_velocities(o, d, arena, &temporaries, out);
    nh_ex *all = nh_arena_alloc(arena, (total + o->d + 1) * sizeof *all);
    const char **name = nh_arena_alloc(arena, (total + o->d + 1) * sizeof *name);
    memcpy(all, o->dx, n * sizeof *all);
    memcpy(all + n, o->F, w * sizeof *all);
    memcpy(all + total, o->zeta, o->d * sizeof *all);
    memcpy(name, targets(arena, "rate_", total), total * sizeof *name);
    memcpy(name + total, targets(arena, "zeta_", o->d), o->d * sizeof *name);
    nh_typeset_c(d, total + o->d, all, name, &temporaries, out);
    nh_text_add(out, "    (void)zeta_;\n    return 0;\n}\n");
}

void nh_reduction_c(const nh_reduction *r, nh_text *out)
{
    nh_text_add(out, "/* ");
    nh_escape_c_comment(r->system->title, out);
    nh_text_add(out, ": reduced equations of motion, written by nhsym " NH_VERSION ". */\n");
    nh_text_add(out, c_head);
    for (size_t i = 0; i < r->stages; i++) put_stage(r, &r->stage[i], i + 1, out);
}

/* ---- LaTeX ---- */

enum { wide_row = 60 }; /* letters that fit on a line beside the name */

static void put_piece(void *context, const char *piece) { nh_text_add(context, piece); }

/* Rows of one alignment when all fit on a line, otherwise paragraphs that TeX breaks. */
static void put_stage_latex(const nh_reduction *r, const nh_reduction_stage *s, nh_text *out)
{
    nh_reduction_equation *e;
    size_t n = nh_reduction_equations(r, s, &e);
    bool rows = true;
    for (size_t k = 0; k < n; k++) {
        char *text = nh_print_short(r->kinetic->dag, e[k].value, r->options.written);
        rows = rows && text && nh_typeset_width(text) < wide_row;
        nh_free(text);
    }
    if (rows) nh_text_add(out, "\\begin{align*}\n");
    for (size_t k = 0; k < n; k++) {
        char *text = nh_print_short(r->kinetic->dag, e[k].value, r->options.written);
        if (!rows) nh_text_add(out, "\\nhformula{");
        nh_typeset(e[k].name, NH_LATEX, out);
        nh_text_add(out, rows ? " &= " : " = ");
        if (!text) nh_text_add(out, "\\text{(too long to be written out)}");
        else if (rows) nh_typeset(text, NH_LATEX, out);
        else nh_typeset_pieces(text, NH_LATEX, NH_TEX_WIDEST, put_piece, out);
        nh_text_add(out, !rows ? "}\n" : k + 1 < n ? " \\\\\n" : "\n");
        nh_free(text);
    }
    if (rows) nh_text_add(out, "\\end{align*}\n");
}

void nh_reduction_latex(const nh_reduction *r, nh_text *out)
{
    nh_text_add(out, "% ");
    nh_escape_line(r->system->title, out);
    nh_text_addf(out, ": reduced equations of motion, written by nhsym " NH_VERSION "; for the package amsmath\n%s", nh_tex_formula_macro);
    for (size_t i = 0; i < r->stages; i++) {
        put_stage_name(r, i, "\n% ", out);
        nh_text_add(out, "\n");
        put_stage_latex(r, &r->stage[i], out);
    }
}
