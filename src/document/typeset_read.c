#include <ctype.h>
#include <string.h>

#include "document/typeset_internal.h"

enum { deepest = 300 };

typedef struct {
    nh_arena *arena;
    const char *at;
    int depth;
} reader;

static nh_formula_node *sum(reader *r);
static nh_formula_node *unary(reader *r);

static nh_formula_node *make(reader *r, nh_formula_node_kind kind, nh_formula_node *child)
{
    nh_formula_node *s = nh_arena_alloc(r->arena, sizeof *s);
    s->kind = kind;
    s->child = child;
    return s;
}

static void skip(reader *r)
{
    while (isspace((unsigned char)*r->at)) r->at++;
}

static bool take(reader *r, char c)
{
    skip(r);
    if (*r->at != c) return false;
    r->at++;
    return true;
}

static nh_formula_node *number(reader *r)
{
    const char *begin = r->at;
    while (isdigit((unsigned char)*r->at) || *r->at == '.') r->at++;
    if (*r->at == 'e' || *r->at == 'E') {
        size_t sign = r->at[1] == '-' || r->at[1] == '+';
        if (isdigit((unsigned char)r->at[1 + sign])) {
            r->at += 1 + sign;
            while (isdigit((unsigned char)*r->at)) r->at++;
        }
    }
    nh_formula_node *s = make(r, NH_FORMULA_NODE_NUMBER, NULL);
    s->text = nh_arena_strndup(r->arena, begin, (size_t)(r->at - begin));
    return s;
}

static bool arguments(reader *r, nh_formula_node *call)
{
    nh_formula_node **last = &call->child;
    if (take(r, ')')) return true;
    do {
        *last = sum(r);
        if (!*last) return false;
        last = &(*last)->next;
    } while (take(r, ','));
    return take(r, ')');
}

static nh_formula_node *name(reader *r)
{
    const char *begin = r->at;
    while (isalnum((unsigned char)*r->at) || *r->at == '_') r->at++;
    nh_formula_node *s = make(r, NH_FORMULA_NODE_NAME, NULL);
    s->text = nh_arena_strndup(r->arena, begin, (size_t)(r->at - begin));
    const char *primes = r->at;
    for (; *r->at == '\''; r->at++) s->primes++;
    if (*primes == '\'' && *r->at == '(') { /* the derivative of a function: V'(r) */
        s->text = nh_arena_strndup(r->arena, begin, (size_t)(r->at - begin));
        s->primes = 0;
    }
    if (s->primes || !take(r, '(')) return s;
    s->kind = NH_FORMULA_NODE_CALL;
    return arguments(r, s) ? s : NULL;
}

static nh_formula_node *atom(reader *r)
{
    skip(r);
    if (isdigit((unsigned char)*r->at) || (*r->at == '.' && isdigit((unsigned char)r->at[1]))) return number(r);
    if (isalpha((unsigned char)*r->at) || *r->at == '_') return name(r);
    if (!take(r, '(')) return NULL;
    nh_formula_node *s = sum(r);
    return s && take(r, ')') ? s : NULL;
}

static nh_formula_node *power(reader *r)
{
    nh_formula_node *base = atom(r);
    if (!base || !take(r, '^')) return base;
    nh_formula_node *exponent = unary(r);
    if (!exponent) return NULL;
    base->next = exponent;
    return make(r, NH_FORMULA_NODE_POWER, base);
}

static nh_formula_node *unary(reader *r)
{
    if (++r->depth > deepest) return NULL;
    nh_formula_node *s;
    if (take(r, '-')) {
        nh_formula_node *inner = unary(r);
        s = inner ? make(r, NH_FORMULA_NODE_MINUS, inner) : NULL;
    } else {
        take(r, '+');
        s = power(r);
    }
    r->depth--;
    return s;
}

static nh_formula_node *times(reader *r, nh_formula_node *left, nh_formula_node *right)
{
    if (left->kind != NH_FORMULA_NODE_PRODUCT) left = make(r, NH_FORMULA_NODE_PRODUCT, left);
    nh_formula_node *last = left->child;
    while (last->next) last = last->next;
    last->next = right;
    nh_formula_node *called = last->kind == NH_FORMULA_NODE_POWER ? last->child : last;
    called->followed = !nh_typeset_names_a_function(right);
    return left;
}

/* a/b/c is one fraction. */
static nh_formula_node *over(reader *r, nh_formula_node *left, nh_formula_node *right)
{
    if (left->kind == NH_FORMULA_NODE_FRACTION) {
        left->child->next = times(r, left->child->next, right);
        return left;
    }
    left->next = right;
    return make(r, NH_FORMULA_NODE_FRACTION, left);
}

/* A parenthesis around a product or a fraction remains one factor. */
static nh_formula_node *factor(reader *r)
{
    nh_formula_node *s = unary(r);
    bool wrapped = s && (s->kind == NH_FORMULA_NODE_PRODUCT || s->kind == NH_FORMULA_NODE_FRACTION);
    return wrapped ? make(r, NH_FORMULA_NODE_PRODUCT, s) : s;
}

static nh_formula_node *term(reader *r)
{
    nh_formula_node *left = factor(r);
    while (left) {
        bool star = take(r, '*'), slash = !star && take(r, '/');
        if (!star && !slash) return left;
        nh_formula_node *right = slash ? unary(r) : factor(r);
        if (!right) return NULL;
        left = star ? times(r, left, right) : over(r, left, right);
    }
    return NULL;
}

static nh_formula_node *sum(reader *r)
{
    if (++r->depth > deepest) return NULL;
    nh_formula_node *first = NULL, **last = &first;
    for (size_t count = 0;; count++) {
        bool minus = take(r, '-');
        if (!minus && !take(r, '+') && count) break;
        nh_formula_node *s = term(r);
        if (!s) return NULL;
        s->minus = minus;
        *last = s;
        last = &s->next;
    }
    r->depth--;
    return first->next || first->minus ? make(r, NH_FORMULA_NODE_SUM, first) : first;
}

nh_formula_node *nh_typeset_read(nh_arena *arena, const char *text)
{
    reader r = {.arena = arena, .at = text};
    nh_formula_node *left = sum(&r);
    if (left && take(&r, '=')) {
        left->next = sum(&r);
        left = left->next ? make(&r, NH_FORMULA_NODE_EQUATION, left) : NULL;
    }
    skip(&r);
    return left && !*r.at ? left : NULL;
}
