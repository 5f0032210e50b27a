/* parse: operators and numbers; names and calls are in parse_names.c. */
#include "graph/parse_internal.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/num_long.h"
#include "graph/spelling.h"

enum {
    max_depth = 200,
    max_power = 310, /* of ten, in an exact decimal */
    max_printed_power = 18,
    fits_64 = 18, /* digits */
    max_digits = 80
};

static const char DIGITS[] = "0123456789", blanks[] = " \t\r\n";

typedef nh_parser parser;

char nh_parse_peek(parser *p)
{
    while (p->text[p->at] && strchr(blanks, p->text[p->at])) p->at++;
    return p->text[p->at];
}

size_t nh_parse_token_end(const parser *p)
{
    size_t end = p->at;
    while (end && strchr(blanks, p->text[end - 1])) end--;
    return end;
}

static bool unary(parser *p, nh_ex *out);

static bool vanishes(nh_num x) { return !nh_num_is(x, 0) && nh_num_value(x) == 0; }

/* Is every coefficient a rational or a double that is neither infinite nor 0?  Products and sums of large and small
 * numbers may overflow or vanish. */
static bool stays_finite(parser *p, nh_ex e, size_t at)
{
    nh_kind kind = nh_kind_of(p->dag, e);
    nh_num first = kind == NH_NUMBER                      ? nh_number_of(p->dag, e)
                   : kind == NH_SUM || kind == NH_PRODUCT ? nh_constant_of(p->dag, e)
                                                          : nh_num_int(1);
    double size = nh_num_value(first);
    bool lost = vanishes(first);
    for (size_t i = 0; kind == NH_SUM && i < nh_arity(p->dag, e); i++) {
        size += fabs(nh_num_value(nh_coefficient_of(p->dag, e, i)));
        lost |= vanishes(nh_coefficient_of(p->dag, e, i));
    }
    if (lost) return nh_parse_fail(p, at, "a number in this expression has become too small: it would be 0");
    return isfinite(size) || nh_parse_fail(p, at, "a number in this expression has become too large") ||
           nh_parse_has_no_value(p);
}

/* ---- numbers ---- */

/* Reads digits with an optional point: the digits alone, from the first that is not 0, and the power of ten by which
 * they are multiplied.  Digits that find no room are left out: *exact is false. */
static const char *mantissa(const char *s, char digits[max_digits + 1], size_t *length, long *scale, bool *exact)
{
    bool point = false;
    *length = 0;
    *scale = 0;
    *exact = true;
    for (; isdigit((unsigned char)*s) || (*s == '.' && !point); s++) {
        if (*s == '.') {
            point = true;
            continue;
        }
        if (*length == max_digits) *exact = false;
        else if (*length > 0 || *s != '0') digits[(*length)++] = *s;
        *scale -= point;
    }
    digits[*length] = 0;
    return s;
}

/* Reads digits with an optional point and exponent; the result is exact unless it is very long, large or small. */
static bool number(parser *p, nh_ex *out)
{
    const char *start = p->text + p->at, *s;
    char digits[max_digits + 1];
    size_t length;
    long scale, exponent = 0;
    bool exact;
    s = mantissa(start, digits, &length, &scale, &exact);
    if ((*s == 'e' || *s == 'E') && strspn(s + 1 + (s[1] == '+' || s[1] == '-'), DIGITS) > 0) {
        char *end;
        exponent = strtol(s + 1, &end, 10);
        s = end;
    }
    double value = strtod(start, NULL);
    if (!isfinite(value)) return nh_parse_fail(p, p->at, "this number is too large");
    if (value == 0 && length) return nh_parse_fail(p, p->at, "this number is too small: it would become 0");
    p->at = (size_t)(s - p->text);
    bool moderate = exponent > -1000 && exponent < 1000; /* so that the sum below cannot overflow */
    bool printed = length >= 16 && length <= 17;         /* from some double, as far as one can tell */
    if (length == 0) {
        *out = nh_int(p->dag, 0);
    } else if (exact && moderate && labs(exponent + scale) <= (printed ? max_printed_power : max_power)) {
        bool fits = length <= fits_64;
        nh_num whole = fits ? nh_num_int(strtoll(digits, NULL, 10)) : nh_num_of_digits(digits, length);
        nh_num ten = nh_num_pow(nh_num_int(10), exponent + scale);
        *out = nh_number(p->dag, nh_num_mul(whole, ten));
    } else {
        *out = nh_real(p->dag, value);
    }
    if (*s == '.') return nh_parse_fail(p, p->at, "a second decimal point in a number");
    if (s == start + 1 && *start == '0' && (*s == 'x' || *s == 'X') && isxdigit((unsigned char)s[1])) {
        nh_parse_fail(p, p->at, "hexadecimal numbers are not read");
        return nh_parse_hint(p, "write `0*%.*s` for a product", (int)strspn(s, "xX0123456789abcdefABCDEF"), s);
    }
    return true;
}

size_t nh_parse_fraction(const char *at, long *top, long *bottom)
{
    static const struct {
        char sign[4], top, bottom;
    } known[] = {{"½", 1, 2}, {"⅓", 1, 3}, {"⅔", 2, 3}, {"¼", 1, 4}, {"¾", 3, 4}, {"⅛", 1, 8}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        size_t length = strlen(known[i].sign);
        *top = known[i].top;
        *bottom = known[i].bottom;
        if (!strncmp(at, known[i].sign, length)) return length;
    }
    return 0;
}

/* ---- operators ---- */

static bool deeper(parser *p)
{
    return ++p->depth <= max_depth || nh_parse_fail(p, p->at, "nested deeper than %d levels", max_depth);
}

bool nh_parse_atom(parser *p, nh_ex *out)
{
    char c = nh_parse_peek(p);
    long top, bottom;
    size_t fraction = nh_parse_fraction(p->text + p->at, &top, &bottom);
    p->number_end = SIZE_MAX;
    if (isdigit((unsigned char)c) || (c == '.' && isdigit((unsigned char)p->text[p->at + 1]))) {
        if (!number(p, out)) return false;
        p->number_end = p->at;
        return true;
    }
    if (fraction) {
        *out = nh_ratio(p->dag, top, bottom);
        p->number_end = p->at += fraction;
        return true;
    }
    if (nh_parse_begins_name(p)) return nh_parse_name(p, out);
    if (c != '(') return nh_parse_no_operand(p);
    p->at++;
    return nh_parse_sum(p, out) && nh_parse_closing(p);
}

/* A number to the power of a number must be a finite number. */
static bool real_power(const nh_dag *dag, nh_ex base, nh_ex exponent)
{
    if (nh_kind_of(dag, base) != NH_NUMBER || nh_kind_of(dag, exponent) != NH_NUMBER) return true;
    return isfinite(pow(nh_num_value(nh_number_of(dag, base)), nh_num_value(nh_number_of(dag, exponent))));
}

bool nh_parse_raise(parser *p, nh_ex base, nh_ex exponent, size_t at, nh_ex *out)
{
    if (!real_power(p->dag, base, exponent))
        return nh_parse_fail(p, at, "this power has no finite value") || nh_parse_has_no_value(p);
    *out = nh_pow(p->dag, base, exponent);
    return stays_finite(p, *out, at);
}

static bool power(parser *p, nh_ex *out)
{
    if (!nh_parse_atom(p, out)) return false;
    bool twice = nh_parse_peek(p) == '*' && p->text[p->at + 1] == '*';
    if (nh_parse_peek(p) != '^' && !twice) return true;
    if (p->bare_end == nh_parse_token_end(p)) return nh_parse_bare_argument_ends(p);
    size_t at = p->at;
    nh_ex base = *out, exponent;
    p->at += 1 + twice;
    /* a parenthesis counts its own depth; a^b^c is no deeper than a^(b^c), as which it is printed */
    bool counted = nh_parse_peek(p) != '(';
    if (counted && !deeper(p)) return false;
    if (!unary(p, &exponent)) return false;
    p->depth -= counted;
    p->number_end = SIZE_MAX;
    return nh_parse_raise(p, base, exponent, at, out);
}

static bool unary(parser *p, nh_ex *out)
{
    char c = nh_parse_peek(p);
    if (c != '-' && c != '+') return power(p, out);
    if (!deeper(p)) return false;
    p->at++;
    if (!unary(p, out)) return false;
    p->depth--;
    if (c == '-') *out = nh_neg(p->dag, *out);
    return true;
}

/* Operands are collected and combined at once: adding n of them one by one would take time n^2. */
typedef struct {
    nh_ex *operand;
    nh_num *sign; /* in sums */
    size_t count, operands, signs;
} chain;

static void chain_push(chain *c, nh_ex operand, int sign)
{
    nh_grow(&c->operand, &c->operands, c->count + 1, sizeof *c->operand);
    nh_grow(&c->sign, &c->signs, c->count + 1, sizeof *c->sign);
    c->operand[c->count] = operand;
    c->sign[c->count++] = nh_num_int(sign);
}

static void chain_clear(chain *c)
{
    nh_free(c->operand);
    nh_free(c->sign);
}

/* The last division of a term: its sign and denominator. */
typedef struct {
    bool open;   /* nothing but the denominator has followed */
    bool number; /* written without blanks around the sign, and the denominator is a number: 1/2 */
    size_t begin, end;
} quotient;

/* `a/b c`: (a/b)*c and a/(b*c) are both meant by some. */
static bool ambiguous_quotient(parser *p, const quotient *q)
{
    char whole[128];
    size_t begin = q->begin + strspn(p->text + q->begin, blanks), next = p->at;
    size_t to =
        next + (p->text[next] == '(' ? strcspn(p->text + next, ")") + 1 : strcspn(p->text + next, " \t\r\n+-*/^(),=;"));
    snprintf(whole, sizeof whole, "(%.*s*%.*s)", (int)(q->end - begin), p->text + begin, (int)(to - next),
             p->text + next);
    nh_parse_fail(p, next, "this product after a quotient can be read in two ways");
    return nh_parse_propose_two(p, (nh_parse_change){q->end, next, "*"}, (nh_parse_change){begin, to, whole});
}

/* Is there a product without a sign?  A number may stand directly before a name or a parenthesis, a name directly
 * behind a prime or a parenthesis; else a blank is between them. */
static bool product_follows(parser *p)
{
    char c = nh_parse_peek(p);
    bool name = nh_parse_begins_name(p);
    if (!name && c != '(') return false;
    size_t end = nh_parse_token_end(p);
    char before = p->text[end - 1];
    return p->at > end || p->number_end == end || (name && (before == '\'' || before == ')'));
}

/* Reads the sign between two factors, `*`, `/`, or ' ' for a product without one; 0: the term ends. */
static bool between_factors(parser *p, const quotient *q, char *sign)
{
    char c = nh_parse_peek(p);
    size_t end = nh_parse_token_end(p);
    bool bare = p->bare_end == end, follows = product_follows(p);
    *sign = c == '*' || c == '/' ? c : follows || (bare && nh_parse_begins_name(p)) ? ' ' : 0;
    if (!*sign) return true;
    if (bare && !(follows && nh_parse_begins_function(p))) return nh_parse_bare_argument_ends(p);
    if (follows && q->open && !(q->number && p->at > end)) return ambiguous_quotient(p, q);
    if (!follows) p->at++;
    p->fault->ordinary |= follows;
    return true;
}

static bool divide(parser *p, nh_ex *divisor, size_t at, quotient *q)
{
    bool tight = !strchr(blanks, p->text[at - 1]) && !strchr(blanks, p->text[at + 1]);
    if (!unary(p, divisor)) return false;
    if (nh_is_zero(p->dag, *divisor)) return nh_parse_fail(p, at, "division by zero") || nh_parse_has_no_value(p);
    *divisor = nh_powi(p->dag, *divisor, -1);
    size_t end = nh_parse_token_end(p);
    *q = (quotient){.open = true, .number = tight && p->number_end == end, .begin = at + 1, .end = end};
    return true;
}

static bool term(parser *p, nh_ex *out)
{
    size_t start = p->at;
    if (!unary(p, out)) return false;
    chain factors = {0};
    chain_push(&factors, *out, 1);
    quotient last = {.open = false};
    bool good = true;
    for (char sign; (good = between_factors(p, &last, &sign)) && sign;) {
        nh_ex next;
        size_t at = p->at - 1;
        last.open &= sign == '/';
        good = sign == '/' ? divide(p, &next, at, &last) : sign == '*' ? unary(p, &next) : power(p, &next);
        if (!good) break;
        chain_push(&factors, next, 1);
    }
    if (good && factors.count > 1) *out = nh_product(p->dag, factors.count, factors.operand);
    bool alone = factors.count == 1;
    chain_clear(&factors);
    return good && (alone || stays_finite(p, *out, start));
}

bool nh_parse_sum(parser *p, nh_ex *out)
{
    if (!deeper(p)) return false;
    nh_parse_peek(p);
    size_t start = p->at;
    if (!term(p, out)) return false;
    chain terms = {0};
    chain_push(&terms, *out, 1);
    bool good = true;
    for (char c; good && ((c = nh_parse_peek(p)) == '+' || c == '-');) {
        p->at++;
        nh_ex next;
        good = term(p, &next);
        if (good) chain_push(&terms, next, c == '+' ? 1 : -1);
    }
    if (good && terms.count > 1) *out = nh_linear(p->dag, terms.count, terms.sign, terms.operand);
    chain_clear(&terms);
    p->depth--;
    return good && stays_finite(p, *out, start);
}

/* Definitions can nest what no single text does. */
static bool finish(parser *p, nh_ex e)
{
    if (nh_parse_peek(p)) return nh_parse_no_operator(p, "an operator or the end of the expression");
    return nh_nesting(p->dag, e) <= max_depth ||
           nh_parse_fail(p, 0, "with its definitions it is nested deeper than %d levels", max_depth);
}

/* A parser of the text as it is written in the language's own signs. */
static parser parser_of(nh_dag *dag, const nh_spelling *spelling, nh_resolve *resolve, void *context,
                        nh_parse_fault *fault)
{
    memset(fault, 0, sizeof *fault);
    fault->ordinary = spelling->own != NULL;
    return (parser){.dag = dag,
                    .text = spelling->text,
                    .number_end = SIZE_MAX,
                    .bare_end = SIZE_MAX,
                    .depth = -1,
                    .resolve = resolve,
                    .context = context,
                    .fault = fault};
}

/* The place of a fault is one in the text as it was written. */
static bool done(bool good, nh_parse_fault *fault, nh_spelling *spelling)
{
    if (!good) fault->offset = nh_spelling_origin(spelling, fault->offset);
    nh_spelling_clear(spelling);
    return good;
}

bool nh_parse(nh_dag *dag, const char *text, nh_resolve *resolve, void *context, nh_ex *out, nh_parse_fault *fault)
{
    nh_spelling spelling = nh_spelling_of(text);
    parser p = parser_of(dag, &spelling, resolve, context, fault);
    return done(nh_parse_sum(&p, out) && finish(&p, *out), fault, &spelling);
}

static bool equation(parser *p, nh_ex *lhs, nh_ex *rhs)
{
    p->equation = true;
    if (!nh_parse_sum(p, lhs)) return false;
    if (!nh_parse_peek(p)) {
        nh_parse_fail(p, p->at, "an equation `... = ...` was expected, but there is no `=`");
        return nh_parse_hint(p, "write `%.100s = 0`", p->text);
    }
    if (nh_parse_peek(p) != '=') return nh_parse_no_operator(p, "an operator or `=`");
    p->at++;
    if (nh_parse_peek(p) == '=') return nh_parse_fail(p, p->at, "an equation is written with a single `=`");
    return nh_parse_sum(p, rhs) && finish(p, *rhs);
}

bool nh_parse_equation(nh_dag *dag, const char *text, nh_resolve *resolve, void *context, nh_ex *lhs, nh_ex *rhs,
                       nh_parse_fault *fault)
{
    nh_spelling spelling = nh_spelling_of(text);
    parser p = parser_of(dag, &spelling, resolve, context, fault);
    return done(equation(&p, lhs, rhs), fault, &spelling);
}
