/* e_(n-1) = sum_j c_j e_j in two steps: which e_j are needed, then the one relation among these.
 *
 * The first step is a rank modulo a prime: of power series along a random curve (relation_space.c) where there are
 * few columns, otherwise, or where a curve says nothing, of the monomials of normal forms (relation_rows.c). The
 * second is nh_relation_find, which proves it; the coefficients are divided by that of the last column. */
#include "exact/relation_express.h"

#include "exact/normal.h"
#include "exact/relation.h"
#include "exact/relation_internal.h"
#include "exact/relation_rows.h"
#include "exact/relation_space.h"
#include "graph/dag.h"
#include "graph/node.h"

/* The symbols of all expressions that are no parameters.  False: there are more than `most`. */
static bool variables_of(const nh_dag *dag, size_t n, const nh_ex *e, size_t parameters, const nh_ex *parameter,
                         size_t most, nh_ex *out, size_t *count)
{
    NH_LIST(symbol);
    bool good = true;
    *count = 0;
    for (size_t j = 0; j < n && good; j++) {
        size_t own = nh_symbols_in(dag, e[j], &symbol);
        good = own <= most;
        for (size_t i = 0; i < own && good; i++) {
            bool known = false;
            for (size_t k = 0; k < parameters && !known; k++) known = parameter[k] == symbol[i];
            for (size_t k = 0; k < *count && !known; k++) known = out[k] == symbol[i];
            if (known) continue;
            good = good && *count < most;
            if (good) out[(*count)++] = symbol[i];
        }
    }
    return good;
}

/* Residues along a curve show at once what is needed, where normal forms of all expressions would have long common
 * denominators; many expressions would need long series. */
static nh_relation_last last(nh_dag *dag, size_t n, const nh_ex *e, size_t parameters, const nh_ex *parameter,
                             bool *support)
{
    enum { most = 64, most_columns = 160 };
    nh_ex variable[most];
    nh_relation_columns q = {.dag = dag, .columns = n, .rows = 1, .entry = e, .variable = variable};
    bool few = n <= most_columns && variables_of(dag, n, e, parameters, parameter, most, variable, &q.variables);
    return few && q.variables > 0 ? nh_relation_space_last(&q, support) : NH_LAST_UNKNOWN;
}

/* The same by normal forms. */
static bool find_support(nh_dag *dag, size_t n, const nh_ex *e, size_t parameters, const nh_ex *parameter,
                         size_t max_terms, bool *support)
{
    nh_relation_question q;
    nh_relation_question_init(&q, dag, n, parameters, parameter, max_terms);
    bool found = nh_relation_question_read(&q, e);
    if (found) {
        nh_relation_system system = nh_relation_question_system(&q);
        nh_relation_rows rows;
        nh_relation_rows_init(&rows, &system);
        found = nh_relation_rows_choose_point(&rows) && nh_relation_rows_last(&rows, support);
        nh_relation_rows_clear(&rows);
    }
    nh_relation_question_clear(&q);
    return found;
}

/* The relation of these columns. */
static bool find(nh_dag *dag, size_t n, const nh_ex *e, size_t parameters, const nh_ex *parameter, size_t max_terms,
                 const bool *support, nh_ex *coefficient)
{
    nh_ex *used = nh_alloc_array(n + 1, sizeof *used), *c = nh_alloc_array(n + 1, sizeof *c);
    size_t count = 0;
    for (size_t j = 0; j < n; j++)
        if (support[j]) used[count++] = e[j];
    bool found = nh_relation_find(dag, count, used, parameters, parameter, max_terms, c) == NH_RELATION_UNIQUE &&
                 !nh_is_zero(dag, c[count - 1]);
    for (size_t j = 0, k = 0; j + 1 < n && found; j++) {
        coefficient[j] = nh_int(dag, 0);
        if (support[j]) coefficient[j] = nh_simplify_short(dag, nh_neg(dag, nh_div(dag, c[k++], c[count - 1])), 0);
    }
    nh_free(c);
    nh_free(used);
    return found;
}

bool nh_relation_express(nh_dag *dag, size_t n, const nh_ex *e, size_t parameters, const nh_ex *parameter,
                         size_t max_terms, nh_ex *coefficient)
{
    bool *support = nh_alloc_array(n + 1, sizeof *support);
    nh_relation_last verdict = n ? last(dag, n, e, parameters, parameter, support) : NH_LAST_IS_FREE;
    bool found =
        verdict == NH_LAST_IS_COMBINED && find(dag, n, e, parameters, parameter, max_terms, support, coefficient);
    if (!found && verdict != NH_LAST_IS_FREE)
        found = find_support(dag, n, e, parameters, parameter, max_terms, support) &&
                find(dag, n, e, parameters, parameter, max_terms, support, coefficient);
    nh_free(support);
    return found;
}
