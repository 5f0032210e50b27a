/* Which solutions are no functions of the known integrals, or no polynomials in them. */
#include "count/construct_internal.h"

#include <math.h>
#include <string.h>

enum { spare = 24, beyond_degree = 2 };

static bool known_differentials(nh_construct_news *x, nh_construct_attempt *a)
{
    nh_differentials all, known;
    nh_count_differentials(a->counter, &all, &known);
    bool good = nh_count_known_differ(a->counter, a->series->ring, a->series->coordinate, &known);
    x->known.width = known.kept + known.n;
    for (size_t i = 0; i < known.rows && good; i++)
        nh_count_space_add(&x->known, a->field, known.row + i * x->known.width);
    nh_count_differentials_clear(&all, &known);
    return good;
}

static nh_residue *solution_differentials(const nh_construct_news *x, const nh_construct_attempt *a,
                                          const nh_graded_count *g)
{
    nh_differentials all, solution;
    nh_count_differentials(a->counter, &all, &solution);
    nh_count_solutions_differ(g, a->field, &solution);
    nh_residue *out = nh_alloc_array(solution.rows * x->known.width + 1, sizeof *out);
    memcpy(out, solution.row, solution.rows * x->known.width * sizeof *out);
    nh_count_differentials_clear(&all, &solution);
    return out;
}

/* Products are compared with solutions of an order that determines them. */
static nh_count_series *short_series(nh_construct_attempt *a, size_t degree)
{
    bool regular;
    size_t order = (degree + beyond_degree) * a->counter->frame->step;
    return nh_count_series_create(a->counter, order < a->series->ring->order ? order : a->series->ring->order, INFINITY,
                                  &regular);
}

static bool known_products(nh_construct_news *x, nh_construct_attempt *a, const nh_count_series *s, size_t degree,
                           nh_count_functionals *f)
{
    nh_count_monomials p = nh_count_monomials_list(a->counter, degree);
    *f = nh_count_functionals_create(s->ring, a->counter->equations->n, p.count + spare, 271828 + degree);
    x->known.width = f->count;
    nh_residue *value = nh_alloc_array(p.count * f->count + 1, sizeof *value);
    bool good = p.count && nh_count_product_values(a->counter, s->ring, s->coordinate, &p, f, value);
    for (size_t i = 0; i < p.count && good; i++) nh_count_space_add(&x->known, a->field, value + i * f->count);
    nh_free(value);
    nh_count_monomials_clear(&p);
    return good;
}

bool nh_construct_news_open(nh_construct_news *x, nh_construct_attempt *a, const nh_construct_question *question)
{
    *x = (nh_construct_news){0};
    nh_count_series *s = question->further ? short_series(a, question->degree) : NULL;
    nh_count_functionals f = {0};
    bool good = s ? known_products(x, a, s, question->degree, &f) : !question->further && known_differentials(x, a);
    for (size_t part = 0; part < a->parts && good; part++) {
        const nh_graded_count *g = a->solution[part];
        size_t N = g->total[g->order];
        if (N && s) {
            x->solution[part] = nh_alloc_array(N * x->known.width + 1, sizeof *x->solution[part]);
            nh_count_solution_values(g, a->series->ring, &f, x->solution[part]);
        } else if (N) {
            x->solution[part] = solution_differentials(x, a, g);
        }
    }
    nh_count_functionals_clear(&f);
    nh_count_series_free(s);
    return good;
}

void nh_construct_news_close(nh_construct_news *x)
{
    nh_free(x->solution[0]);
    nh_free(x->solution[1]);
    nh_free(x->known.row);
}

bool nh_construct_news_add(nh_construct_news *x, const nh_construct_attempt *a, size_t part,
                           const nh_residue *combination)
{
    const nh_graded_count *g = a->solution[part];
    nh_residue *sum = nh_alloc_array(x->known.width + 1, sizeof *sum);
    for (size_t s = 0; s < g->total[g->order]; s++)
        nh_residue_add_multiple(a->field, x->known.width, sum, x->solution[part] + s * x->known.width, combination[s]);
    bool grows = nh_count_space_add(&x->known, a->field, sum);
    nh_free(sum);
    return grows;
}

size_t nh_construct_news_count(nh_construct_news *x, const nh_construct_attempt *a, size_t part, size_t rows,
                               const nh_residue *combination)
{
    const nh_graded_count *g = a->solution[part];
    size_t before = x->known.rows, count = 0;
    for (size_t i = 0; i < rows; i++) count += nh_construct_news_add(x, a, part, combination + i * g->total[g->order]);
    x->known.rows = before;
    return count;
}
