/* The words of a classification for each question. */
#include "document/classification_internal.h"

#include "count/count.h"

static const struct {
    const char *subject; /* the subject of the whole classification */
    const char *where;   /* heading of the special values, and of sentences about them */
    const char *more;    /* "more ..." */
} WORDS[NH_LINEAR_QUESTIONS] = {
    [NH_OF_CURRENTS] = {"integrals polynomial in the velocities", "Special values",
                        "more conserved quantities than the others"},
    [NH_OF_MEASURE] = {"invariant measures exp(sigma(q)) dq dw", "Values with an invariant measure",
                       "an invariant measure (a preserved volume)"},
    [NH_OF_HAMILTONIZATION] =
        {"conformal factors on the shape space, by which the reduced equations become Hamiltonian",
         "Values with a conformal factor", "a conformal factor"},
    [NH_OF_SYMMETRIES] = {"infinitesimal symmetries of Lagrangian and constraints", "Values with more symmetries",
                          "more symmetries than the others"},
    [NH_OF_INTEGRABILITY] = {"directions that brackets of the allowed motions have", "Values with fewer directions",
                             "fewer directions of motion than the others"},
};

const char *nh_classification_subject(const nh_classified *x) { return WORDS[x->of].subject; }
const char *nh_classification_where(const nh_classified *x) { return WORDS[x->of].where; }
const char *nh_classification_more(const nh_classified *x) { return WORDS[x->of].more; }

const char *nh_classification_side(const nh_classified *x)
{
    return x->of == NH_OF_CURRENTS ? nh_count_where(x->almost_all->model) : NULL;
}

void nh_classification_level(const nh_classified *x, size_t level, nh_text *out)
{
    switch (x->of) {
    case NH_OF_MEASURE: nh_text_add(out, "densities"); return;
    case NH_OF_HAMILTONIZATION: nh_text_add(out, "factors"); return;
    case NH_OF_SYMMETRIES: nh_text_add(out, "symmetries"); return;
    case NH_OF_INTEGRABILITY: nh_text_addf(out, "brackets up to length %zu", level + 1); return;
    default: nh_text_addf(out, "degree %zu", level);
    }
}

void nh_classification_amount(const nh_classified *x, size_t bound, nh_text *out)
{
    bool word = x->of == NH_OF_MEASURE || x->of == NH_OF_HAMILTONIZATION;
    bool rank = x->of == NH_OF_INTEGRABILITY && x->question;
    if (word && bound < 2) nh_text_add(out, bound ? "one" : "none");
    else nh_text_addf(out, "%zu", rank ? x->question->family.unknowns - bound : bound);
}

void nh_classification_beyond(const nh_classified *x, size_t bound, nh_text *out)
{
    bool any = (x->of == NH_OF_MEASURE || x->of == NH_OF_HAMILTONIZATION) && !bound;
    nh_text_add(out, any ? "one" : x->of == NH_OF_INTEGRABILITY ? "less than " : "more than ");
    if (!any) nh_classification_amount(x, bound, out);
}
