/* analysis_file_ansatz: the families of an analysis file. */
#include <string.h>

#include "graph/dag.h"
#include "problem/analysis_file_internal.h"

static bool read_in(nh_analysis_file_reader *r, const nh_deck_node *item, nh_family *f)
{
    const nh_deck_node *in = nh_deck_get(item, "in");
    if (!in) return nh_deck_fail(r->a->deck, item, 0, r->error, "this family needs `in`, the list of its variables");
    size_t n = in->kind == NH_DECK_LIST ? in->count : 1;
    if (n == 0) return nh_deck_fail(r->a->deck, in, 0, r->error, "this `in` is empty; name at least one variable");
    nh_ex *list = nh_analysis_file_take(r, n, sizeof *list);
    for (size_t i = 0; i < n; i++)
        if (!nh_analysis_file_parse(r, in->kind == NH_DECK_LIST ? in->item[i] : in, &list[i])) return false;
    f->in = list;
    f->in_count = n;
    return true;
}

static bool read_size(nh_analysis_file_reader *r, const nh_deck_node *item, const char *key, long fallback, size_t *out)
{
    const nh_deck_node *node = nh_deck_get(item, key);
    long value = fallback;
    if (node && !nh_deck_whole(r->a->deck, node, key, 0, 200, &value, r->error)) return false;
    if (value < 0) return nh_deck_fail(r->a->deck, item, 0, r->error, "this family needs a `%s`", key);
    *out = (size_t)value;
    return true;
}

static bool read_terms(nh_analysis_file_reader *r, const nh_deck_node *item, nh_family *f)
{
    const nh_deck_node *list = nh_deck_get(item, "terms");
    if (!nh_deck_is(r->a->deck, list, NH_DECK_LIST, "terms", r->error)) return false;
    if (list->count == 0) return nh_deck_fail(r->a->deck, list, 0, r->error, "this list of terms is empty");
    nh_ex *term = nh_analysis_file_take(r, list->count, sizeof *term);
    for (size_t i = 0; i < list->count; i++)
        if (!nh_analysis_file_parse(r, list->item[i], &term[i])) return false;
    *f = (nh_family){.kind = NH_TERMS, .terms = list->count, .term = term};
    return true;
}

static bool read_family(nh_analysis_file_reader *r, const nh_deck_node *item, int depth, nh_family *f);

static bool read_product(nh_analysis_file_reader *r, const nh_deck_node *item, int depth, nh_family *f)
{
    const nh_deck_node *list = nh_deck_get(item, "product");
    if (!nh_deck_is(r->a->deck, list, NH_DECK_LIST, "product", r->error)) return false;
    if (list->count == 0) return nh_deck_fail(r->a->deck, list, 0, r->error, "this product is empty");
    nh_family *part = nh_analysis_file_take(r, list->count, sizeof *part);
    for (size_t i = 0; i < list->count; i++)
        if (!read_family(r, list->item[i], depth + 1, &part[i])) return false;
    *f = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = list->count, .part = part};
    return true;
}

static bool has_key(const char *keys, const char *key)
{
    size_t n = strlen(key);
    for (const char *found = strstr(keys, key); found; found = strstr(found + 1, key))
        if ((found == keys || found[-1] == ' ') && (found[n] == ',' || !found[n])) return true;
    return false;
}

/* Has the family only keys with a meaning for its kind? */
static bool fits(nh_analysis_file_reader *r, const nh_deck_node *item, const char *kind, const char *keys)
{
    for (size_t i = 0; i < item->count; i++) {
        if (has_key(keys, item->key[i]->text)) continue;
        nh_deck_fail(r->a->deck, item->key[i], 0, r->error, "`%s` means nothing for %s", item->key[i]->text, kind);
        return nh_error_hint(r->error, "it takes: %s", keys);
    }
    return true;
}

static const struct {
    const char *name, *keys;
    bool single;
} families[] = {
#define X(kind, name, keys, single, columns) {#name, keys, single},
    NH_FAMILY_TABLE(X)
#undef X
};

/* A family with a name, by the keys that it has. */
static bool read_basis(nh_analysis_file_reader *r, const nh_deck_node *item, nh_family *f)
{
    const char *names[sizeof families / sizeof *families], *keys, *kind;
    size_t count = sizeof families / sizeof *families, k = 0;
    const nh_deck *deck = r->a->deck;
    const nh_deck_node *frequency = nh_deck_get(item, "frequency"), *constant = nh_deck_get(item, "constant");
    for (size_t i = 0; i < count; i++) names[i] = families[i].name;
    if (!nh_analysis_file_choice(deck, nh_deck_get(item, "basis"), "basis", count, names, &k, r->error)) return false;
    keys = families[k].keys;
    kind = nh_arena_printf(r->a->arena, "a %s family", names[k]);
    if (!fits(r, item, kind, keys)) return false;
    *f = (nh_family){.kind = (nh_family_kind)k, .frequency = nh_int(r->model->dag, 1), .constant = frequency == NULL};
    if (constant && !nh_deck_is(deck, constant, NH_DECK_SCALAR, "constant", r->error)) return false;
    if (constant) f->constant = !strcmp(constant->text, "true");
    if (constant && !f->constant && strcmp(constant->text, "false"))
        return nh_deck_fail(deck, constant, 0, r->error, "`constant` must be true or false, found `%s`",
                            constant->text);
    if (frequency && !nh_analysis_file_parse(r, frequency, &f->frequency)) return false;
    bool degree = has_key(keys, "degree");
    if (!read_in(r, item, f) || !read_size(r, item, degree ? "degree" : "harmonics", degree ? -1 : 1, &f->degree))
        return false;
    if (!families[k].single || f->in_count == 1) return true;
    return nh_deck_fail(deck, item, 0, r->error, "%s is in one variable; use a product for several", kind);
}

static bool read_family(nh_analysis_file_reader *r, const nh_deck_node *item, int depth, nh_family *f)
{
    static const char *const keys[] = {"basis",     "in",       "degree", "harmonics",
                                       "frequency", "constant", "terms",  "product"};
    const nh_deck *deck = r->a->deck;
    if (!nh_deck_is(deck, item, NH_DECK_MAP, "a family {basis: ..., in: ...}", r->error)) return false;
    if (!nh_deck_only(deck, item, keys, sizeof keys / sizeof *keys, r->error)) return false;
    if (depth > 4) return nh_deck_fail(deck, item, 0, r->error, "products nested too deeply");
    if (nh_deck_get(item, "product")) return fits(r, item, "a product", "product") && read_product(r, item, depth, f);
    if (nh_deck_get(item, "terms")) return fits(r, item, "a list of terms", "terms") && read_terms(r, item, f);
    if (nh_deck_get(item, "basis")) return read_basis(r, item, f);
    return nh_deck_fail(deck, item, 0, r->error, "a family needs `basis`, `terms` or `product`");
}

bool nh_analysis_file_read_ansatz(nh_analysis_file_reader *r)
{
    const nh_deck_node *list = nh_deck_get(r->root, "ansatz");
    if (!list) return true;
    if (!nh_deck_is(r->a->deck, list, NH_DECK_LIST, "ansatz", r->error)) return false;
    r->a->family = nh_analysis_file_take(r, list->count, sizeof *r->a->family);
    for (size_t i = 0; i < list->count; i++)
        if (!read_family(r, list->item[i], 0, &r->a->family[i])) return false;
    r->a->families = list->count;
    return true;
}
