/* What is said of other integrals: for each verdict the exact sentences, no word too many, and the keys of the JSON.  The verdicts are made by hand, those of tests/test_absence.c
 * are not. */
#include <cjson/cJSON.h>

#include "analysed.h"
#include "document/absence_parts.h"
#include "document/absence_words.h"
#include "document/analysis.h"
#include "document/screen.h"
#include "graph/dag.h"

static const char PLANE[] = "name: cubic\ncoordinates:\n  - {name: x, type: length}\n  - {name: y, type: length}\nparameters: [{name: B, value: 1}]\n"
                            "lagrangian: (x'^2 + y'^2)/2 - (x^2 + B*y^2)/2 - x^2*y + y^3/3\n";
static const char SPRING[] = "name: spring\ncoordinates:\n  - {name: x, type: length}\n  - {name: y, type: length}\nparameters: [{name: k, value: 3}]\n"
                             "lagrangian: (x'^2 + y'^2)/2 - k*(sqrt(x^2 + y^2) - 1)^2/2 - 2*y\ndomain: {x: [0.5, 1], y: [0.5, 1]}\n";
static const char TURNING[] = "name: turning\ncoordinates:\n  - {name: s, type: length}\n  - {name: theta, type: angle}\n  - {name: z, type: length}\n"
                              "lagrangian: (s'^2 + theta'^2 + z'^2)/2 + s*cos(theta) - s^3\n";

/* An analysis, and an answer to the question whether there is any other integral. */
typedef struct {
    nh_analysis *r;
    nh_absence a;
    nh_closed_shape shape;
    nh_absence_attempt attempt[2];
    nh_normal_equation equation[2];
    nh_plane plane[2];
    nh_kovacic kovacic;
    nh_monodromy monodromy;
    nh_residues residues;
    nh_darboux darboux;
    nh_resonance rest, *rests[1];
    size_t known[4], used[4];
} answer;

/* The letters are all coordinates but the last `left`, and all velocities. */
static void make(answer *x, const char *text, size_t left)
{
    *x = (answer){.r = analysed_text(text)};
    const nh_model *o = x->r->question->model;
    nh_arena *arena = x->r->arena;
    nh_closed_shape *s = &x->shape;
    *s = (nh_closed_shape){.model = o, .coordinates = o->m - left, .count = o->m - left + o->n, .left = left};
    s->letter = nh_arena_alloc(arena, (o->m + o->n) * sizeof *s->letter);
    s->rate = nh_arena_alloc(arena, (o->m + o->n) * sizeof *s->rate);
    s->angle = nh_arena_alloc(arena, (o->m + o->n) * sizeof *s->angle);
    s->left_out = nh_arena_alloc(arena, (left + 1) * sizeof *s->left_out);
    for (size_t i = 0; i < s->coordinates; i++) {
        s->letter[i] = o->system->coordinate[i].q;
        s->rate[i] = o->rho[i];
        s->angle[i] = o->system->coordinate[i].type == NH_ANGLE;
    }
    for (size_t i = 0; i < left; i++) s->left_out[i] = o->system->coordinate[s->coordinates + i].q;
    for (size_t i = 0; i < o->n; i++) s->letter[s->coordinates + i] = o->chart->w[i], s->rate[s->coordinates + i] = o->a[i];
    x->plane[0].words = x->plane[1].words = "x = 0";
    for (size_t i = 0; i < 2; i++) {
        x->equation[i] = (nh_normal_equation){.plane = &x->plane[i], .level = nh_ratio(o->dag, 1, 7), .curve = "y'^2 = 2/7 - y^2 + 2/3*y^3", .variable = "y", .known = 1, .used = x->used, .dimension = 2, .blocks = 1, .single_valued = true};
        x->attempt[i] = (nh_absence_attempt){.equation = &x->equation[i], .p = "(x^2 - x)/(2/7 - x^2 + 2/3*x^3)", .q = "-(1 + 2*x)/(2/7 - x^2 + 2/3*x^3)"};
    }
    static slong lowest[3] = {-1, 0, 2}, degrees[2] = {0, 3};
    static ulong pole[3] = {5, 11, 1073742390}, root[4] = {2, 3, 4, 5};
    static bool twice[3] = {true, true, true};
    static const char *exponent[4] = {"1/2", "1/2", "1/2", "5/3"}, *trace[4] = {"2.5", "-1.25", "1.5", "3"};
    x->kovacic = (nh_kovacic){.group = NH_GROUP_SL2, .regular = true, .r_num = "3*x^2-x+7", .r_den = "x^4 - 2", .prime = 1073742391, .poles = 3, .pole = pole, .double_pole = twice, .root = root, .exponent = exponent, .degrees = 2, .degree_of_p = degrees, .sign_vectors = 8,
                              .invariant = {{.m = 4, .possible = true, .lowest = lowest, .degree = 2}, {.m = 6}, {.m = 8, .possible = true, .lowest = lowest, .degree = 5}, {.m = 12}}};
    x->monodromy = (nh_monodromy){.size = 4, .rank = 4, .bits = 512, .singular = 2, .steps = 300, .words = 5, .trace = trace};
    x->residues = (nh_residues){.verdict = NH_RESIDUE_MEROMORPHIC, .factor = "x^2 - 2", .residue = "3*x"};
    x->darboux = (nh_darboux){.applies = true, .degree = 3, .points = 4, .refuted = true, .refutation = {.point = "c = (1, 0)", .eigenvalue = "5"}};
    x->rest = (nh_resonance){.point = "x = 0, x' = 0", .polynomial = "x^5 + x^4 + 3", .letters = 5, .span = 4, .diagonalizable = true, .at_most = 1, .prime = 101};
    x->rests[0] = &x->rest;
    x->a = (nh_absence){.verdict = NH_ABSENCE_NONE_ELSE, .shape = &x->shape, .known = x->r->list->independent < 4 ? x->r->list->independent : 4, .known_current = x->known, .at_most = 1, .generic = true, .planes = 2, .attempts = 2, .attempt = x->attempt, .best = 0};
    for (size_t i = 0; i < 4; i++) x->known[i] = x->used[i] = i;
    x->attempt[0].kovacic = &x->kovacic;
    x->attempt[0].orbit = 2;
    x->r->absence = &x->a;
}

static void end(answer *x) { nh_analysis_free(x->r); }

/* Words that would be false, or say nothing. */
static void check_words(const char *text)
{
    static const char *const forbidden[] = {"chaotic", "chaos", "no integral exists", "no further analytic", "no analytic integral", "not integrable.", "generic"};
    for (size_t i = 0; i < sizeof forbidden / sizeof *forbidden; i++) cr_expect_null(strcasestr(text, forbidden[i]), "%s: %s", forbidden[i], text);
    const char *parameters = strstr(text, "arameters outside");
    cr_expect(!parameters || strstr(parameters, "countably many hypersurfaces"), "%s", text);
}

static void says(const answer *x, const char *expected)
{
    const char *text = nh_absence_words_sentence(x->r);
    cr_assert_not_null(text);
    check_words(text);
    cr_expect_str_eq(text, expected, "\n%s\n%s", text, expected);
}

/* On a first screen: at most four lines. */
static void says_briefly(const answer *x, const char *expected)
{
    const char *text = nh_absence_words_short(x->r, 4);
    if (!expected) {
        cr_expect_null(text, "%s", text);
        return;
    }
    cr_assert_not_null(text);
    check_words(text);
    nh_text block;
    nh_text_init(&block);
    nh_screen_paragraph(0, 0, text, &block);
    cr_expect_leq(nh_screen_count(nh_text_string(&block)), 4, "%s", nh_text_string(&block));
    nh_text_clear(&block);
    cr_expect_str_eq(text, expected, "\n%s\n%s", text, expected);
}

/* The level is that of the integral which determines the curve, of the energy or of another one. */
Test(absence_words, levels)
{
    answer x;
    make(&x, "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - x^2 - y^4 - z\n", 0);
    cr_assert_geq(x.a.known, 2U);
    cr_expect_not_null(strstr(nh_absence_words_sentence(x.r), "x = 0 of energy 1/7 "), "%s", nh_absence_words_sentence(x.r));
    x.used[0] = 1;
    cr_expect_not_null(strstr(nh_absence_words_sentence(x.r), "x = 0 at the level 1/7 of Phi2 "), "%s", nh_absence_words_sentence(x.r));
    cr_expect_not_null(strstr(nh_absence_words_short(x.r, 4), "x = 0 at the level 1/7 of quantity 2 "), "%s", nh_absence_words_short(x.r, 4));
    x.a.known = 1;
    x.known[0] = 1;
    x.used[0] = 0;
    cr_expect_not_null(strstr(nh_absence_words_sentence(x.r), "x = 0 at the level 1/7 is "), "%s", nh_absence_words_sentence(x.r));
    end(&x);
}

Test(absence_words, none_else)
{
    answer x;
    make(&x, PLANE, 0);
    says(&x, "No other integral: every first integral of the equations of x, y, x', y' that is meromorphic near the complex motions x = 0 of energy 1/7 is a function of those found (theorem; the Galois group of their normal variational equation is SL(2); proved modulo 1073742391; so too for all values of the parameters outside countably many hypersurfaces). "
             "Also excluded: finitely many-valued ones. "
             "Not excluded: integrals with other singularities on these complex motions (logarithms, irrational powers; real-analytic ones may have them), smooth ones, and integrals that contain t.");
    says_briefly(&x, "No other integral: every first integral of the equations of x, y, x', y' that is meromorphic near the complex motions x = 0 of energy 1/7 is a function of the one above (theorem; Galois group SL(2)). Not excluded: ones with other singularities there, smooth ones, ones that contain t.");
    x.a.generic = false;
    cr_expect_null(strstr(nh_absence_words_sentence(x.r), "hypersurfaces"));
    x.a.verdict = NH_ABSENCE_DEPENDENT;
    says(&x, "No other integral: every first integral of the equations of x, y, x', y' that is meromorphic near the complex motions x = 0 of energy 1/7 depends on those found (theorem; the Galois group of their normal variational equation is SL(2); proved modulo 1073742391). "
             "Also excluded: finitely many-valued ones. "
             "Not excluded: integrals with other singularities on these complex motions (logarithms, irrational powers; real-analytic ones may have them), smooth ones, and integrals that contain t.");
    end(&x);
}

/* Where an irregular point was used: rational ones only, by Theorem A'. */
Test(absence_words, rational_class)
{
    answer x;
    make(&x, PLANE, 0);
    x.a.rational = true;
    says(&x, "No other integral: every first integral of the equations of x, y, x', y' that is rational in these is a function of those found (theorem; the Galois group of their normal variational equation is SL(2); proved modulo 1073742391; so too for all values of the parameters outside countably many hypersurfaces). "
             "Also excluded: algebraic ones. Not excluded: integrals that are not rational, and integrals that contain t.");
    says_briefly(&x, "No other integral: every first integral of the equations of x, y, x', y' that is rational in these is a function of the one above (theorem; Galois group SL(2); so too for all parameters outside countably many hypersurfaces). Not excluded: ones that are not rational, ones that contain t.");
    cr_expect_null(strstr(nh_absence_words_sentence(x.r), "meromorphic"));
    end(&x);
}

/* A root is a letter, and named. */
Test(absence_words, roots)
{
    answer x;
    const char **root;
    make(&x, SPRING, 0);
    cr_assert_eq(nh_absence_parts_roots(x.r->arena, &x.shape, &root), 1);
    cr_expect_str_eq(root[0], "sqrt(x^2 + y^2)");
    x.a.generic = false;
    says(&x, "No other integral: every first integral of the equations of x, y, x', y' that is meromorphic in these and sqrt(x^2 + y^2), where that is not 0, near the complex motions x = 0 of energy 1/7 is a function of those found (theorem; the Galois group of their normal variational equation is SL(2); proved modulo 1073742391). "
             "Also excluded: finitely many-valued ones. "
             "Not excluded: integrals with other singularities on these complex motions (logarithms, irrational powers; real-analytic ones may have them), smooth ones, and integrals that contain t.");
    x.a.rational = true;
    cr_expect(strstr(nh_absence_words_sentence(x.r), "that is rational in these and sqrt(x^2 + y^2) is a function"), "%s", nh_absence_words_sentence(x.r));
    end(&x);
}

/* Letters left out are named; SL(2) is its own commutator group, other groups see periodic integrals only. */
Test(absence_words, angles_and_letters_left_out)
{
    answer x;
    make(&x, TURNING, 1);
    x.plane[0].words = "theta = pi";
    x.a.known = 1;
    says(&x, "No other integral: every first integral of the equations of s, theta, s', theta', z' that is meromorphic near the complex motions theta = pi of energy 1/7 is a function of Phi1 (theorem; the Galois group of their normal variational equation is SL(2); proved modulo 1073742391). "
             "Also excluded: finitely many-valued ones, and ones that are not periodic in the angles. "
             "Not excluded: integrals with other singularities on these complex motions (logarithms, irrational powers; real-analytic ones may have them), smooth ones, and integrals that contain z or t.");
    says_briefly(&x, "No other integral: every first integral of the equations of s, theta, s', theta', z' that is meromorphic near the complex motions theta = pi of energy 1/7 is a function of quantity 1 (theorem; Galois group SL(2)). Not excluded: ones with other singularities there, smooth ones, ones that contain z or t.");
    /* the same by residues, d = 1 */
    x.attempt[0].kovacic = NULL;
    x.attempt[0].residues = &x.residues;
    x.attempt[0].orbit = x.equation[0].dimension = 1;
    x.a.many_valued = 1;
    says(&x, "No other integral: every first integral of the equations of s, theta, s', theta', z' that is meromorphic near the complex motions theta = pi of energy 1/7 and 2 pi-periodic in theta is a function of Phi1 (theorem; loops multiply the solutions of their normal variational equation, which is of first order, by numbers that are no roots of unity: a residue is not rational). "
             "Also excluded: finitely many-valued ones. "
             "Not excluded: integrals with other singularities on these complex motions (logarithms, irrational powers; real-analytic ones may have them), smooth ones, ones that are not periodic in the angles, and integrals that contain z or t. "
             "1 of those found is many-valued near these motions, or contains t: it is not of this class.");
    x.residues.verdict = NH_RESIDUE_RATIONAL;
    x.a.rational = true;
    x.a.many_valued = 0;
    says(&x, "No other integral: every first integral of the equations of s, theta, s', theta', z' that is rational in s, sin(theta), cos(theta), s', theta', z' is a function of Phi1 (theorem; the solutions of their normal variational equation, which is of first order, are not algebraic). "
             "Also excluded: algebraic ones. Not excluded: integrals that are not rational, and integrals that contain z or t.");
    end(&x);
}

Test(absence_words, at_most)
{
    answer x;
    make(&x, PLANE, 0);
    x.a.verdict = NH_ABSENCE_AT_MOST;
    x.a.at_most = 3;
    x.a.generic = false;
    x.attempt[0].kovacic = NULL;
    x.attempt[0].monodromy = &x.monodromy;
    x.attempt[0].orbit = 4, x.equation[0].dimension = 5, x.equation[0].blocks = 2;
    says(&x, "At most 3 independent first integrals of the equations of x, y, x', y' are meromorphic near the complex motions x = 0 of energy 1/7 (theorem; the monodromy of their normal variational equation moves a general vector in 4 of 5 dimensions, taken on its 2 blocks together; proved in balls of 512 bits); 1 is known. "
             "So too where finitely many-valued ones are counted. "
             "Not excluded: integrals with other singularities on these complex motions (logarithms, irrational powers; real-analytic ones may have them), smooth ones, and integrals that contain t.");
    says_briefly(&x, "At most 3 independent first integrals of the equations of x, y, x', y' are meromorphic near the complex motions x = 0 of energy 1/7 (theorem; monodromy, in balls); 1 is known. Not excluded: ones with other singularities there, smooth ones, ones that contain t.");
    end(&x);
}

Test(absence_words, liouville)
{
    answer x;
    make(&x, PLANE, 0);
    x.a.verdict = NH_ABSENCE_LIOUVILLE;
    x.equation[0].dimension = 4;
    says(&x, "Not integrable in the sense of Liouville: the equations of x, y, x', y' do not have as many independent first integrals in involution as degrees of freedom, all of them meromorphic near the complex motions x = 0 of energy 1/7 (theorem; a block of their normal variational equation has the Galois group SL(2); proved modulo 1073742391; so too for all values of the parameters outside countably many hypersurfaces). "
             "Not excluded: a further integral alone, integrals with other singularities on these complex motions (logarithms, irrational powers; real-analytic ones may have them), smooth ones, and integrals that contain t.");
    end(&x);
}

/* A block with SL(2) beside others: the group may have a torus, which sees periodic integrals only.  Against commuting integrals the block is enough. */
Test(absence_words, one_block)
{
    answer x;
    make(&x, TURNING, 1);
    x.a.verdict = NH_ABSENCE_AT_MOST;
    x.a.at_most = 2, x.a.known = 1;
    x.equation[0].dimension = 3, x.equation[0].blocks = 2;
    cr_expect_eq(nh_absence_parts_reason_of(&x.a), NH_ABSENCE_BY_BLOCK);
    cr_expect(strstr(nh_absence_words_sentence(x.r), " and 2 pi-periodic in theta (theorem; a block of their normal variational equation has the Galois group SL(2)"), "%s", nh_absence_words_sentence(x.r));
    x.a.verdict = NH_ABSENCE_LIOUVILLE;
    cr_expect_null(strstr(nh_absence_words_sentence(x.r), "periodic"));
    x.kovacic.group = NH_GROUP_TRIANGULAR;
    cr_expect(strstr(nh_absence_words_sentence(x.r), "2 pi-periodic in theta (theorem; the Galois group of their normal variational equation is SL(2) or triangular, of dimension 2"), "%s", nh_absence_words_sentence(x.r));
    /* balls on the direct sum */
    x.kovacic.group = NH_GROUP_SL2;
    x.a.verdict = NH_ABSENCE_NONE_ELSE;
    x.attempt[0].monodromy = &x.monodromy, x.attempt[0].orbit = x.equation[0].dimension = 4;
    cr_expect_eq(nh_absence_parts_reason_of(&x.a), NH_ABSENCE_BY_MONODROMY);
    cr_expect(strstr(nh_absence_words_sentence(x.r), "2 pi-periodic in theta"), "%s", nh_absence_words_sentence(x.r));
    end(&x);
}

Test(absence_words, homogeneous_potential)
{
    answer x;
    make(&x, PLANE, 0);
    x.a.best = x.a.attempts;
    x.a.darboux = &x.darboux;
    x.a.generic = false;
    says(&x, "No other integral: every first integral of the equations of x, y, x', y' that is meromorphic near the complex motions on the line along c = (1, 0) is a function of those found (theorem of Morales-Ruiz and Ramis: the potential is homogeneous of degree 3, and its second derivatives have the eigenvalue 5 there, at which the motions near by have the Galois group SL(2)). "
             "Also excluded: finitely many-valued ones. "
             "Not excluded: integrals with other singularities on these complex motions (logarithms, irrational powers; real-analytic ones may have them), smooth ones, and integrals that contain t.");
    end(&x);
}

/* Nothing is excluded: nothing on the first screen, but for --absence. */
Test(absence_words, open_and_settled)
{
    answer x;
    make(&x, PLANE, 0);
    x.a.verdict = NH_ABSENCE_OPEN;
    x.a.best = x.a.attempts;
    x.a.obstacle = "no motion of one coordinate leaves the others at rest";
    says(&x, "Not decided whether there is any other integral: no motion of one coordinate leaves the others at rest. Nothing is excluded by this, and nothing is found.");
    says_briefly(&x, NULL);
    x.a.everything = true;
    says_briefly(&x, "Not decided whether there is any other integral: no motion of one coordinate leaves the others at rest.");
    x.a.verdict = NH_ABSENCE_SETTLED;
    says(&x, "As many integrals are known as there can be.");
    says_briefly(&x, NULL);
    end(&x);
}

Test(absence_words, contradiction_is_an_error)
{
    answer x;
    make(&x, PLANE, 0);
    x.a.contradiction = "Phi2 is an integral that was excluded";
    static const char text[] = "An error of this program: Phi2 is an integral that was excluded. So nothing is said of other integrals. Please report it with the system file and the JSON of this analysis.";
    says(&x, text);
    says_briefly(&x, text);
    cr_expect_str_eq(nh_absence_parts_verdict(&x.a), "contradiction");
    end(&x);
}

/* Theorem E, which speaks of real-analytic integrals. */
Test(absence_words, states_of_rest)
{
    answer x;
    make(&x, TURNING, 1);
    x.a.verdict = NH_ABSENCE_OPEN;
    x.a.best = x.a.attempts;
    x.a.resonances = 1;
    x.a.resonance = x.rests;
    x.rest.divergence = true;
    says(&x, "Not decided whether there is any other integral. Nothing is excluded by this, and nothing is found. "
             "Near x = 0, x' = 0, where the equations of s, theta, s', theta', z' rest, at most 1 independent first integral of theirs is real-analytic, or a quotient of real-analytic functions (theorem; the eigenvalues there span at least 4 dimensions over the rational numbers; proved modulo 101). No measure with a positive density of class C^1 is preserved near x = 0, x' = 0.");
    says_briefly(&x, "Near x = 0, x' = 0, where the equations of s, theta, s', theta', z' rest, at most 1 independent first integral of theirs is real-analytic, or a quotient of real-analytic functions (theorem; the eigenvalues there span at least 4 dimensions over the rational numbers; proved modulo 101).");
    /* no prime was needed */
    x.rest = (nh_resonance){.point = "x = 0, x' = 0", .polynomial = "x^5", .letters = 5, .span = 1, .diagonalizable = false, .at_most = 3};
    cr_expect(strstr(nh_absence_words_sentence(x.r), "at most 3 independent first integrals of theirs are real-analytic, or quotients of real-analytic functions (theorem; the eigenvalues there span at least 1 dimension over the rational numbers, and the linear equations cannot be diagonalized)."),
              "%s", nh_absence_words_sentence(x.r));
    x.rest.at_most = 0;
    cr_expect(strstr(nh_absence_words_sentence(x.r), "rest, of their first integrals only constants are real-analytic, or quotients"), "%s", nh_absence_words_sentence(x.r));
    x.rest.at_most = 4; /* as everywhere */
    says(&x, "Not decided whether there is any other integral. Nothing is excluded by this, and nothing is found.");
    says_briefly(&x, NULL);
    end(&x);
}

/* Where it was not asked nothing is written, and the member is null. */
Test(absence_words, not_asked)
{
    answer x;
    make(&x, PLANE, 0);
    x.r->absence = NULL;
    cr_expect_null(nh_absence_words_sentence(x.r));
    says_briefly(&x, NULL);
    char *text = nh_analysis_json(x.r);
    cJSON *root = cJSON_Parse(text);
    cr_expect(cJSON_IsNull(cJSON_GetObjectItem(root, "absence")));
    cJSON_Delete(root);
    nh_free(text);
    end(&x);
}

/* ---- JSON and documents ---- */

static const cJSON *at(const cJSON *of, const char *key)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(of, key);
    cr_assert_not_null(item, "%s", key);
    return item;
}

static void is_list(const cJSON *list, size_t n, const char *const *text)
{
    cr_assert_eq((size_t)cJSON_GetArraySize(list), n, "%s: %d", list->string, cJSON_GetArraySize(list));
    for (size_t i = 0; i < n; i++) cr_expect_str_eq(cJSON_GetArrayItem(list, (int)i)->valuestring, text[i], "%s", list->string);
}

Test(absence_words, json)
{
    answer x;
    make(&x, TURNING, 1);
    x.a.resonances = 1, x.a.resonance = x.rests, x.a.darboux = &x.darboux;
    x.a.known = 1;
    x.attempt[1].obstacle = "the group is finite";
    char *text = nh_analysis_json(x.r);
    cJSON *root = cJSON_Parse(text);
    const cJSON *a = at(root, "absence");
    cr_expect_str_eq(at(a, "verdict")->valuestring, "none else");
    cr_expect_str_eq(at(a, "sentence")->valuestring, nh_absence_words_sentence(x.r));
    cr_expect_str_eq(at(a, "class")->valuestring, "meromorphic");
    is_list(at(a, "letters"), 5, (const char *const[]){"s", "theta", "s'", "theta'", "z'"});
    is_list(at(a, "left_out"), 1, (const char *const[]){"z"});
    is_list(at(a, "known"), 1, (const char *const[]){"Phi1"});
    cr_expect(cJSON_IsFalse(at(a, "periodic")) && cJSON_IsTrue(at(a, "generic")));
    cr_expect_eq(at(a, "at_most")->valuedouble, 1);
    cr_expect_eq(at(a, "decided_by")->valuedouble, 0);
    cr_assert_eq(cJSON_GetArraySize(at(a, "motions")), 2);
    const cJSON *m = cJSON_GetArrayItem(at(a, "motions"), 0), *c = at(m, "certificate");
    cr_expect_str_eq(at(m, "level")->valuestring, "1/7");
    cr_expect_str_eq(at(m, "group")->valuestring, "SL(2)");
    is_list(at(c, "r_num"), 3, (const char *const[]){"7", "-1", "3"});
    is_list(at(c, "r_den"), 5, (const char *const[]){"-2", "0", "0", "0", "1"});
    cr_expect_eq(at(c, "prime")->valuedouble, 1073742391);
    cr_expect_eq(cJSON_GetArrayItem(at(c, "poles"), 2)->valuedouble, 1073742390);
    cr_assert_eq(cJSON_GetArraySize(at(c, "invariants")), 2);
    const cJSON *v = cJSON_GetArrayItem(at(c, "invariants"), 1);
    cr_expect_eq(at(v, "m")->valuedouble, 8);
    cr_expect_eq(cJSON_GetArrayItem(at(v, "lowest"), 0)->valuedouble, -1);
    const cJSON *second = cJSON_GetArrayItem(at(a, "motions"), 1);
    cr_expect(cJSON_IsNull(at(second, "certificate")) && cJSON_IsNull(at(second, "monodromy")) && cJSON_IsNull(at(second, "residues")));
    cr_expect_str_eq(at(second, "obstacle")->valuestring, "the group is finite");
    cr_expect_eq(at(at(a, "darboux"), "degree")->valuedouble, 3);
    cr_expect_eq(at(cJSON_GetArrayItem(at(a, "rest"), 0), "at_most")->valuedouble, 1);
    cJSON_Delete(root);
    nh_free(text);
    end(&x);
}

/* Every member stands in the schema, and every one that is required is there. */
static void fits(const cJSON *schema, const cJSON *v, const char *name)
{
    for (const cJSON *m = cJSON_IsObject(v) ? v->child : NULL; m; m = m->next) {
        const cJSON *own = cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItem(schema, "properties"), m->string);
        cr_assert_not_null(own, "%s.%s is not in the schema", name, m->string);
        fits(own, m, m->string);
    }
    const cJSON *required = cJSON_IsObject(v) ? cJSON_GetObjectItem(schema, "required") : NULL;
    for (const cJSON *key = required ? required->child : NULL; key; key = key->next) at(v, key->valuestring);
    for (const cJSON *e = cJSON_IsArray(v) ? v->child : NULL; e; e = e->next) fits(cJSON_GetObjectItem(schema, "items"), e, name);
}

Test(absence_words, schema)
{
    answer x;
    make(&x, PLANE, 0);
    x.a.resonances = 1, x.a.resonance = x.rests, x.a.darboux = &x.darboux;
    x.attempt[0].monodromy = &x.monodromy;
    x.attempt[1].residues = &x.residues;
    FILE *file = fopen("docs/schema/analyze.json", "r");
    cr_assert_not_null(file);
    nh_text text;
    nh_text_init(&text);
    char part[4096];
    for (size_t n; (n = fread(part, 1, sizeof part, file)) > 0;) nh_text_add_n(&text, part, n);
    fclose(file);
    char *json = nh_analysis_json(x.r);
    cJSON *schema = cJSON_Parse(nh_text_string(&text)), *root = cJSON_Parse(json);
    const cJSON *whole = cJSON_GetArrayItem(at(schema, "oneOf"), 0);
    fits(at(at(whole, "properties"), "absence"), at(root, "absence"), "absence");
    cJSON_Delete(schema), cJSON_Delete(root);
    nh_text_clear(&text);
    nh_free(json);
    end(&x);
}

/* No class where nothing is excluded: a reader of the JSON must not take the bound of nothing for one. */
Test(absence_words, json_of_nothing)
{
    answer x;
    make(&x, PLANE, 0);
    x.a.verdict = NH_ABSENCE_OPEN, x.a.best = x.a.attempts;
    for (int contradiction = 0; contradiction < 2; contradiction++) {
        if (contradiction) x.a.verdict = NH_ABSENCE_NONE_ELSE, x.a.contradiction = "two engines disagree";
        char *text = nh_analysis_json(x.r);
        cJSON *root = cJSON_Parse(text);
        const cJSON *a = at(root, "absence");
        cr_expect_str_eq(at(a, "verdict")->valuestring, contradiction ? "contradiction" : "open");
        cr_expect(cJSON_IsNull(at(a, "class")) && cJSON_IsNull(at(a, "at_most")) && cJSON_IsFalse(at(a, "generic")));
        cJSON_Delete(root);
        nh_free(text);
    }
    end(&x);
}

/* The section, in each form of a document. */
static char *document(const answer *x, nh_pen_form form)
{
    nh_text text;
    nh_text_init(&text);
    nh_analysis_write(x->r, (nh_pen_style){.form = form, .verbose = true}, &text);
    cr_expect_null(strpbrk(nh_text_string(&text), NH_ABSENCE_WORDS_FORMULA NH_ABSENCE_WORDS_END), "marks are left");
    char *copy = strdup(nh_text_string(&text)), *to = copy;
    for (const char *c = copy; *c;) { /* lines that go on become one */
        bool broken = *c == '\n' && !strncmp(c + 1, "    ", 4);
        *to++ = broken ? ' ' : *c;
        c += broken ? 1 + strspn(c + 1, " ") : 1;
    }
    *to = 0;
    nh_text_clear(&text);
    return copy;
}

static void has(const char *text, const char *part) { cr_expect(strstr(text, part), "no %s in\n%s", part, text); }

Test(absence_words, documents)
{
    answer x;
    make(&x, SPRING, 0);
    x.a.resonances = 1, x.a.resonance = x.rests, x.a.darboux = &x.darboux;
    char *plain = document(&x, NH_PEN_TEXT), *page = document(&x, NH_PEN_PAGE), *tex = document(&x, NH_PEN_LATEX);
    has(plain, "Other integrals\n");
    has(plain, "No other integral: every first integral of the equations of x, y, x', y'");
    has(plain, "Normal form: u'' = r*u, r = (3*x^2 - x + 7)/(x^4 - 2)");
    has(plain, "Only what costs little was tried");
    has(page, "<section id=\"absence\">");
    has(page, "href=\"#absence\"");
    has(page, "Why the group is SL(2)");
    has(page, "Motions that were tried, and the normal variational equations along them");
    has(tex, "Other integrals");
    has(tex, "\\sqrt{x^{2} + y^{2}}");
    free(plain), free(page), free(tex);
    /* other certificates */
    x.attempt[0].kovacic = NULL;
    x.attempt[0].monodromy = &x.monodromy, x.attempt[0].orbit = 4, x.equation[0].dimension = 4, x.equation[0].blocks = 2;
    x.a.everything = true;
    plain = document(&x, NH_PEN_TEXT);
    has(plain, "at least 4 of 4 dimensions");
    has(plain, "x = 0, level 1/7: y'^2 = 2/7 - y^2 + 2/3*y^3; normal equation of size 4 in 2 blocks; group: moves in 4 of 4 dimensions");
    has(plain, "-1.25");
    cr_expect_null(strstr(plain, "Only what costs little"));
    free(plain);
    /* nothing to say: no section */
    x.a = (nh_absence){.verdict = NH_ABSENCE_SETTLED, .shape = &x.shape};
    page = document(&x, NH_PEN_PAGE);
    cr_expect_null(strstr(page, "#absence"));
    cr_expect_null(strstr(page, "id=\"absence\""));
    free(page);
    /* an error of the program is a warning */
    x.a = (nh_absence){.verdict = NH_ABSENCE_NONE_ELSE, .shape = &x.shape, .contradiction = "two engines disagree"};
    page = document(&x, NH_PEN_PAGE);
    has(page, "<p class=\"warning\"><strong>Warning:</strong> An error of this program: two engines disagree.");
    free(page);
    end(&x);
}

/* The first screen of `analyze`. */
Test(absence_words, first_screen)
{
    answer x;
    make(&x, PLANE, 0);
    nh_text text;
    nh_text_init(&text);
    nh_analysis_write_answer(x.r, false, &text);
    has(nh_text_string(&text), "\nNo other integral: every first integral of the equations of x, y, x', y' that is\nmeromorphic near the complex motions x = 0 of energy 1/7");
    nh_text_clear(&text);
    x.a.verdict = NH_ABSENCE_OPEN;
    nh_analysis_write_answer(x.r, false, &text);
    cr_expect_null(strstr(nh_text_string(&text), "other integral"));
    nh_text_clear(&text);
    end(&x);
}
