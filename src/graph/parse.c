#include "graph/parse.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "graph/declared.h"
#include "graph/measure.h"
#include "graph/num_long.h"

enum {
    max_depth = 200,
    max_name = 63,
    max_power = 310, /* of ten, in an exact decimal */
    max_printed_power = 18,
    fits_64 = 18, /* digits */
    max_digits = 80
};

static const char DIGITS[] = "0123456789",
                  WORD[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";

typedef struct {
    nh_dag *dag;
    const char *text;
    size_t at;
    int depth;
    bool equation; /* parsing "lhs = rhs" */
    nh_resolve *resolve;
    void *context;
    nh_parse_fault *fault;
} parser;

static bool fail(parser *p, size_t offset, const char *format, ...) __attribute__((format(printf, 3, 4)));
static bool fail(parser *p, size_t offset, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vsnprintf(p->fault->what, sizeof p->fault->what, format, list);
    va_end(list);
    p->fault->offset = offset;
    p->fault->hint[0] = 0;
    return false;
}

/* A correct text may have no value. */
static bool has_no_value(parser *p) { return !(p->fault->undefined = true); }

static bool hint(parser *p, const char *format, ...) __attribute__((format(printf, 2, 3)));
static bool hint(parser *p, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vsnprintf(p->fault->hint, sizeof p->fault->hint, format, list);
    va_end(list);
    return false;
}

static char peek(parser *p)
{
    while (p->text[p->at] && strchr(" \t\r\n", p->text[p->at])) p->at++;
    return p->text[p->at];
}

static bool is_letter(char c) { return isalpha((unsigned char)c) || c == '_'; }
static bool is_word(char c) { return isalnum((unsigned char)c) || c == '_'; }

static bool find_function(const char *name, nh_function *out)
{
    for (int f = 0; f < NH_FUNCTION_COUNT; f++) {
        if (f == NH_PI || f == NH_UNSPECIFIED || strcmp(name, nh_function_name((nh_function)f))) continue;
        *out = (nh_function)f;
        return true;
    }
    return false;
}

bool nh_is_reserved(const char *name)
{
    nh_function f;
    return find_function(name, &f) || !strcmp(name, "pi") || !strcmp(name, "t") || !strcmp(name, "sqrt");
}

/* Does a name begin here, possibly with a Greek letter? */
static bool begins_name(parser *p)
{
    char word[max_name + 2];
    return nh_name_spelled(p->text + p->at, word, sizeof word) && is_letter(*word);
}

static bool expression(parser *p, nh_ex *out);
static bool unary(parser *p, nh_ex *out);

/* A hint for common mistakes: 9,81 for 9.81; two equations in one text; a quote at one end only. */
static bool hint_separator(parser *p)
{
    const char *at = p->text + p->at;
    if (*at == '"') return hint(p, "a value that ends with a quote begins with one, too");
    if (*at != ',') return false;
    if (p->at && isdigit((unsigned char)at[-1]) && isdigit((unsigned char)at[1]))
        return hint(p, "decimals are written with a point: 9.81");
    if (p->equation) return hint(p, "each equation is an item of its own: [\"x' = y'\", \"y' = z'\"]");
    return false;
}

/* Names the wrong character in words. */
static bool unexpected(parser *p, const char *wanted)
{
    char c = peek(p);
    if (!c) return fail(p, p->at, "the expression ends here, but %s was expected", wanted);
    if ((unsigned char)c >= 0x80) {
        size_t length;
        const char *plain = nh_name_of_sign(p->text + p->at), *letter = nh_name_of_letter(p->text + p->at, &length);
        fail(p, p->at, "a character that the expression language does not have; %s was expected", wanted);
        if (plain) return hint(p, "write `%s`", plain);
        return hint(p, "names consist of the letters a-z, A-Z, digits and _%s%s%s", letter ? ": write `" : "",
                    letter ? letter : "", letter ? "`" : "");
    }
    if (iscntrl((unsigned char)c))
        return fail(p, p->at, "a control character cannot stand here; %s was expected", wanted);
    fail(p, p->at, "`%c` cannot stand here; %s was expected", c, wanted);
    if (c == ',' || c == '"') return hint_separator(p);
    if (c == '\\') return hint(p, "formulas are no LaTeX: write x', sqrt(x), cos(phi), a/b");
    if ((c == '<' || c == '>') && p->equation)
        return hint(p, "only equations can be written: where a motion is looked at, `domain:` says");
    if (c == '=' && p->equation) return hint(p, "an equation has one `=` between two expressions");
    if (c == '=')
        return hint(p, "an equation is expected only under constraints, forces, definitions and the map of velocities");
    return false;
}

/* The text behind a complete operand, where an operator or `closing` is expected. */
static bool no_operator(parser *p, const char *closing)
{
    char c = peek(p);
    if (!is_word(c) && !begins_name(p) && c != '(') return unexpected(p, closing);
    fail(p, p->at, "an operator is missing before this");
    return hint(p, "there is no implicit multiplication: write `*`");
}

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
    if (lost) return fail(p, at, "a number in this expression has become too small: it would be 0");
    return isfinite(size) || fail(p, at, "a number in this expression has become too large") || has_no_value(p);
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
    if (!isfinite(value)) return fail(p, p->at, "this number is too large");
    if (value == 0 && length) return fail(p, p->at, "this number is too small: it would become 0");
    p->at = (size_t)(s - p->text);
    bool moderate = exponent > -1000 && exponent < 1000; /* so that the sum below cannot overflow */
    bool printed = length >= 16 && length <= 17; /* from some double, as far as one can tell */
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
    if (*s == '.') return fail(p, p->at, "a second decimal point in a number");
    if (!is_letter(*s) && *s != '(') return true;
    fail(p, p->at, "there is no implicit multiplication");
    if (!strncmp(s, "deg", 3))
        return hint(p, "angles are in radians: write %.*s*pi/180", (int)(s - start > 20 ? 20 : s - start), start);
    return hint(p, "write `%.*s*%.*s`", (int)(s - start > 20 ? 20 : s - start), start,
                *s == '(' ? 1 : (int)strspn(s, WORD), s);
}

/* ---- names and calls ---- */

static bool close_parenthesis(parser *p)
{
    if (peek(p) != ')') return no_operator(p, "an operator or `)`");
    p->at++;
    return true;
}

static bool wrong_number(parser *p, const char *name, const char *amount)
{
    nh_function f;
    fail(p, p->at, "`%s` takes %s", name, amount);
    return find_function(name, &f) && nh_is_named_function(f) &&
           hint(p, "write %s(%s)", name, nh_function_arguments(f));
}

/* Reads the arguments of `name`, behind it. */
static bool arguments(parser *p, const char *name, size_t count, nh_ex *argument)
{
    static const char *const amount[] = {"no", "one argument", "two arguments", "three arguments", "four arguments"};
    if (peek(p) != '(') {
        bool power = peek(p) == '^';
        fail(p, p->at, "`%s` is a function; `(` was expected after it", name);
        return hint(p, power ? "write `%s(...)^2`" : "write `%s(...)`", name);
    }
    p->at++;
    for (size_t i = 0; i < count; i++) {
        if (!expression(p, &argument[i])) return false;
        char c = peek(p);
        if (c == (i + 1 < count ? ')' : ',')) return wrong_number(p, name, amount[count]);
        if (i + 1 < count && c != ',') return no_operator(p, "an operator or `,`");
        if (c == ',') p->at++;
    }
    return close_parenthesis(p);
}

/* Reads f(a) or f(a, b) behind the name, which stands at offset `at`. */
static bool call(parser *p, nh_function f, const char *name, size_t at, nh_ex *out)
{
    nh_ex a[NH_MOST_ARGUMENTS];
    if (!arguments(p, name, nh_function_arity(f), a)) return false;
    *out = nh_call_any(p->dag, f, a);
    if (nh_kind_of(p->dag, *out) == NH_NUMBER && !isfinite(nh_num_value(nh_number_of(p->dag, *out))))
        return fail(p, at, "`%s` has no finite value here", name) || has_no_value(p);
    return true;
}

static bool square_root(parser *p, size_t at, nh_ex *out)
{
    nh_ex a;
    if (!arguments(p, "sqrt", 1, &a)) return false;
    if (nh_kind_of(p->dag, a) == NH_NUMBER && nh_num_value(nh_number_of(p->dag, a)) < 0)
        return fail(p, at, "the square root of a negative number") || has_no_value(p);
    *out = nh_sqrt(p->dag, a);
    return true;
}

/* The caller does not know the name, or has explained why it cannot stand here. */
static bool unresolved(parser *p, const char *word, size_t at)
{
    nh_parse_fault *fault = p->fault;
    bool unknown = !fault->what[0] || !strncmp(fault->what, "unknown name", strlen("unknown name")),
         called = peek(p) == '(';
    fault->offset = at;
    if (unknown) snprintf(fault->what, sizeof fault->what, "unknown %s `%s`", called ? "function" : "name", word);
    const char *instead = unknown && called ? nh_function_elsewhere(word) : NULL,
               *near = unknown && called ? nh_function_nearest(word) : NULL; /* nearer than the coordinate s is to sn(x) */
    if (instead) return hint(p, "%s", instead);
    if (near) return hint(p, "did you mean `%s`?", near);
    if (!unknown || !called || !strncmp(fault->hint, "did you mean", strlen("did you mean"))) return false;
    return hint(p,
                "the functions are: " NH_ELEMENTARY_WORDS "atan2 sqrt abs, those of `nhsym explain functions`, and "
                "those that a system declares: functions: [\"%.40s(x)\"]",
                word);
}

/* Reads a name that is not the language's own: the caller resolves it. */
static bool resolved(parser *p, const char *word, size_t at, nh_ex *out)
{
    nh_parse_fault *fault = p->fault;
    fault->what[0] = fault->hint[0] = 0;
    if (!p->resolve(p->context, word, out, fault)) return unresolved(p, word, at);
    if (peek(p) != '(') return true;
    fail(p, p->at, "`%s` is not a function, and there is no implicit multiplication", word);
    return hint(p, "write `%s*(`", word);
}

/* V(x), V'(x), V''(x) of a function that the file declares. */
static bool declared_call(parser *p, const char *word, size_t f, nh_ex *out)
{
    size_t primes = strspn(p->text + p->at, "'");
    nh_ex argument;
    if (primes > NH_DECLARED_PRIMES)
        return fail(p, p->at, "derivatives up to order %d can be written", NH_DECLARED_PRIMES);
    p->at += primes;
    if (!arguments(p, word, 1, &argument)) return false;
    *out = nh_declared_call(p->dag, f, primes, argument);
    return true;
}

static bool name(parser *p, nh_ex *out)
{
    size_t declared, start = p->at;
    char word[max_name + 3];
    p->at += nh_name_spelled(p->text + start, word, max_name + 2);
    if (strlen(word) > max_name) return fail(p, start, "a name longer than %d characters", max_name);
    nh_function f;
    if (nh_declared_find(p->dag, word, &declared)) return declared_call(p, word, declared, out);
    if (!strcmp(word, "sqrt")) return square_root(p, start, out);
    if (find_function(word, &f)) return call(p, f, word, start, out);
    if (!strcmp(word, "pi")) {
        *out = nh_pi(p->dag);
        return true;
    }
    if (p->text[p->at] == '\'') {
        strcat(word, "'");
        p->at++;
        if (p->text[p->at] == '\'')
            return fail(p, start,
                        "second derivatives cannot be used: a system is written with coordinates and velocities");
    }
    return resolved(p, word, start, out);
}

/* ---- operators ---- */

static bool deeper(parser *p)
{
    return ++p->depth <= max_depth || fail(p, p->at, "nested deeper than %d levels", max_depth);
}

static bool atom(parser *p, nh_ex *out)
{
    char c = peek(p);
    if (isdigit((unsigned char)c) || (c == '.' && isdigit((unsigned char)p->text[p->at + 1]))) return number(p, out);
    if (begins_name(p)) return name(p, out);
    if (c != '(') return unexpected(p, "a number, a name or `(`");
    p->at++;
    return expression(p, out) && close_parenthesis(p);
}

/* A number to the power of a number must be a finite number. */
static bool real_power(const nh_dag *dag, nh_ex base, nh_ex exponent)
{
    if (nh_kind_of(dag, base) != NH_NUMBER || nh_kind_of(dag, exponent) != NH_NUMBER) return true;
    return isfinite(pow(nh_num_value(nh_number_of(dag, base)), nh_num_value(nh_number_of(dag, exponent))));
}

static bool power(parser *p, nh_ex *out)
{
    if (!atom(p, out)) return false;
    bool twice = peek(p) == '*' && p->text[p->at + 1] == '*';
    if (peek(p) != '^' && !twice) return true;
    size_t at = p->at;
    nh_ex base = *out, exponent;
    p->at += 1 + twice;
    /* a parenthesis counts its own depth; a^b^c is no deeper than a^(b^c), as which it is printed */
    bool counted = peek(p) != '(';
    if (counted && !deeper(p)) return false;
    if (!unary(p, &exponent)) return false;
    p->depth -= counted;
    if (!real_power(p->dag, base, exponent)) return fail(p, at, "this power has no finite value") || has_no_value(p);
    *out = nh_pow(p->dag, base, exponent);
    return stays_finite(p, *out, at);
}

static bool unary(parser *p, nh_ex *out)
{
    char c = peek(p);
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

static bool term(parser *p, nh_ex *out)
{
    size_t start = p->at;
    if (!unary(p, out)) return false;
    if (peek(p) != '*' && peek(p) != '/') return true;
    chain factors = {0};
    chain_push(&factors, *out, 1);
    bool good = true;
    for (char c; good && ((c = peek(p)) == '*' || c == '/');) {
        size_t at = p->at++;
        nh_ex next;
        good = unary(p, &next);
        if (good && c == '/' && nh_is_zero(p->dag, next)) good = fail(p, at, "division by zero") || has_no_value(p);
        if (good) chain_push(&factors, c == '/' ? nh_powi(p->dag, next, -1) : next, 1);
    }
    if (good) *out = nh_product(p->dag, factors.count, factors.operand);
    chain_clear(&factors);
    return good && stays_finite(p, *out, start);
}

static bool expression(parser *p, nh_ex *out)
{
    if (!deeper(p)) return false;
    peek(p);
    size_t start = p->at;
    if (!term(p, out)) return false;
    chain terms = {0};
    chain_push(&terms, *out, 1);
    bool good = true;
    for (char c; good && ((c = peek(p)) == '+' || c == '-');) {
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
    if (peek(p)) return no_operator(p, "an operator or the end of the expression");
    return nh_nesting(p->dag, e) <= max_depth ||
           fail(p, 0, "with its definitions it is nested deeper than %d levels", max_depth);
}

bool nh_parse(nh_dag *dag, const char *text, nh_resolve *resolve, void *context, nh_ex *out, nh_parse_fault *fault)
{
    memset(fault, 0, sizeof *fault);
    parser p = {.dag = dag, .text = text, .resolve = resolve, .context = context, .fault = fault, .depth = -1};
    return expression(&p, out) && finish(&p, *out);
}

bool nh_parse_equation(nh_dag *dag, const char *text, nh_resolve *resolve, void *context, nh_ex *lhs, nh_ex *rhs,
                       nh_parse_fault *fault)
{
    memset(fault, 0, sizeof *fault);
    parser p = {.dag = dag, .text = text, .resolve = resolve, .context = context, .fault = fault, .depth = -1};
    p.equation = true;
    if (!expression(&p, lhs)) return false;
    if (peek(&p) != '=') {
        if (!peek(&p)) {
            fail(&p, p.at, "an equation `... = ...` was expected, but there is no `=`");
            return hint(&p, "write `%.100s = 0`", text);
        }
        return no_operator(&p, "an operator or `=`");
    }
    p.at++;
    if (peek(&p) == '=') return fail(&p, p.at, "an equation is written with a single `=`");
    return expression(&p, rhs) && finish(&p, *rhs);
}
