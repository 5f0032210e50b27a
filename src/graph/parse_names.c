/* parse_names: names, calls, and derivatives by time. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "graph/dag.h"
#include "graph/declared.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/parse_internal.h"

typedef nh_parser parser;

static bool is_letter(char c) { return isalpha((unsigned char)c) || c == '_'; }

bool nh_parse_begins_name(const parser *p)
{
    char word[NH_PARSE_NAME + 2];
    return nh_name_spelled(p->text + p->at, word, sizeof word) && is_letter(*word);
}

bool nh_parse_begins_function(const parser *p)
{
    char word[NH_PARSE_NAME + 2];
    nh_function f;
    nh_name_spelled(p->text + p->at, word, sizeof word);
    return nh_name_is_function(word, &f) || !strcmp(word, "sqrt");
}

bool nh_parse_closing(parser *p)
{
    if (nh_parse_peek(p) != ')') return nh_parse_no_operator(p, "an operator or `)`");
    p->at++;
    return true;
}

/* ---- arguments ---- */

static bool wrong_number(parser *p, const char *name, const char *amount)
{
    nh_function f;
    nh_parse_fail(p, p->at, "`%s` takes %s", name, amount);
    return nh_name_is_function(name, &f) && nh_is_named_function(f) &&
           nh_parse_hint(p, "write %s(%s)", name, nh_function_arguments(f));
}

/* sin x: one number or name is an argument without parentheses. */
static bool bare_argument(parser *p, const char *name, nh_ex *argument)
{
    char c = nh_parse_peek(p);
    bool operand = isdigit((unsigned char)c) || (nh_parse_begins_name(p) && !nh_parse_begins_function(p));
    if (!operand) {
        nh_parse_fail(p, p->at, "`%s` is a function; `(` was expected after it", name);
        return nh_parse_hint(p, "write `%s(...)`", name);
    }
    size_t begin = p->at;
    if (!nh_parse_atom(p, argument)) return false;
    p->fault->ordinary = true;
    p->bare_end = p->at;
    p->bare_begin = begin;
    p->number_end = SIZE_MAX;
    return true;
}

bool nh_parse_bare_argument_ends(parser *p)
{
    size_t begin = p->bare_begin, end = p->bare_end, from = begin, to = p->at;
    char one[NH_PARSE_NAME + 16], all[128];
    bool sign = strchr("*/^", p->text[to]);
    to += sign + strspn(p->text + to + sign, " *");
    to += p->text[to] == '(' ? strcspn(p->text + to, ")") + 1 : strcspn(p->text + to, " +-*/^(),=;");
    while (from && p->text[from - 1] == ' ') from--;
    nh_parse_fail(p, p->at, "does this belong to the argument of the function?");
    snprintf(one, sizeof one, "(%.*s)%s", (int)(end - begin), p->text + begin, sign ? "" : "*");
    snprintf(all, sizeof all, "(%.*s%s%.*s)", (int)(end - begin), p->text + begin, sign ? "" : "*", (int)(to - p->at),
             p->text + p->at);
    return nh_parse_propose_two(p, (nh_parse_change){from, to, all}, (nh_parse_change){from, p->at, one});
}

/* Reads the arguments of `name`, behind it. */
static bool arguments(parser *p, const char *name, size_t count, nh_ex *argument)
{
    static const char *const amount[] = {"no", "one argument", "two arguments", "three arguments", "four arguments"};
    if (nh_parse_peek(p) != '(' && count == 1) return bare_argument(p, name, argument);
    if (nh_parse_peek(p) != '(') {
        nh_parse_fail(p, p->at, "`%s` is a function; `(` was expected after it", name);
        return nh_parse_hint(p, "write `%s(...)`", name);
    }
    p->at++;
    for (size_t i = 0; i < count; i++) {
        if (!nh_parse_sum(p, &argument[i])) return false;
        char c = nh_parse_peek(p);
        if (c == (i + 1 < count ? ')' : ',')) return wrong_number(p, name, amount[count]);
        if (i + 1 < count && c != ',') return nh_parse_no_operator(p, "an operator or `,`");
        if (c == ',') p->at++;
    }
    return nh_parse_closing(p);
}

/* sin^2(x), sin^2 x: the exponent between the name and its argument, a whole number above 0. */
static bool function_power(parser *p, const char *name, size_t start, nh_ex *exponent)
{
    size_t at = p->at + 1;
    p->at++;
    bool closed = nh_parse_peek(p) == '(', digit = isdigit((unsigned char)p->text[p->at + closed]);
    if (digit && nh_parse_atom(p, exponent) && nh_kind_of(p->dag, *exponent) == NH_NUMBER) return true;
    nh_function f;
    char inverse[32];
    snprintf(inverse, sizeof inverse, "a%.20s", name);
    nh_parse_fail(p, start, "an exponent after the name of a function must be a number above 0");
    return p->text[at] == '-' && p->text[at + 1] == '1' && nh_name_is_function(inverse, &f)
               ? nh_parse_hint(p, "write `%s(...)`, or `1/%s(...)`", inverse, name)
               : nh_parse_hint(p, "write `%s(...)^(...)`", name);
}

/* Reads f(a) or f(a, b) behind the name, which stands at offset `at`. */
static bool call(parser *p, nh_function f, const char *name, size_t at, nh_ex *out)
{
    nh_ex a[NH_MOST_ARGUMENTS];
    if (!arguments(p, name, nh_function_arity(f), a)) return false;
    *out = nh_call_any(p->dag, f, a);
    if (nh_kind_of(p->dag, *out) == NH_NUMBER && !isfinite(nh_num_value(nh_number_of(p->dag, *out))))
        return nh_parse_fail(p, at, "`%s` has no finite value here", name) || nh_parse_has_no_value(p);
    return true;
}

static bool square_root(parser *p, size_t at, nh_ex *out)
{
    nh_ex a;
    if (!arguments(p, "sqrt", 1, &a)) return false;
    if (nh_kind_of(p->dag, a) == NH_NUMBER && nh_num_value(nh_number_of(p->dag, a)) < 0)
        return nh_parse_fail(p, at, "the square root of a negative number") || nh_parse_has_no_value(p);
    *out = nh_sqrt(p->dag, a);
    return true;
}

/* Any function of the language, behind its name. */
static bool function(parser *p, nh_function f, bool root, const char *word, size_t start, nh_ex *out)
{
    nh_ex exponent;
    size_t at = p->at;
    bool raised = nh_parse_peek(p) == '^';
    p->fault->ordinary |= raised;
    if (raised && !function_power(p, word, start, &exponent)) return false;
    if (!(root ? square_root(p, start, out) : call(p, f, word, start, out))) return false;
    return !raised || nh_parse_raise(p, *out, exponent, at, out);
}

/* The derivative of order n of a table: V(x), V'(x); V(x, y), V_x(x, y), V_xy(x, y). */
static bool table_call(parser *p, const char *word, size_t f, size_t n, nh_ex *out)
{
    size_t count = nh_declared_table(p->dag, f)->y ? 2 : 1;
    nh_ex argument[2] = {0, nh_int(p->dag, 0)};
    if (count == 1 && n >= NH_SPLINE_ORDERS) return *out = nh_int(p->dag, 0), arguments(p, word, 1, argument);
    if (!arguments(p, word, count, argument)) return false;
    *out = nh_declared_call_table(p->dag, f, n, argument[0], argument[1]);
    return true;
}

/* V(x), V'(x), V''(x) of a function that the file declares. */
static bool declared_call(parser *p, const char *word, size_t f, nh_ex *out)
{
    size_t primes = strspn(p->text + p->at, "'");
    nh_ex argument;
    if (primes > NH_DECLARED_PRIMES)
        return nh_parse_fail(p, p->at, "derivatives up to order %d can be written", NH_DECLARED_PRIMES);
    p->at += primes;
    if (nh_parse_peek(p) != '(') {
        nh_parse_fail(p, p->at, "`%s` is a function; `(` was expected after it", word);
        return nh_parse_hint(p, "write `%s(...)`", word);
    }
    if (nh_declared_table(p->dag, f)) return table_call(p, word, f, primes, out);
    if (!arguments(p, word, 1, &argument)) return false;
    *out = nh_declared_call(p->dag, f, primes, argument);
    return true;
}

/* ---- derivatives by time ---- */

/* Does the caller know the word?  No fault is left. */
static bool knows(parser *p, const char *word, nh_ex *out)
{
    nh_parse_fault kept = *p->fault;
    p->fault->what[0] = 0;
    bool known = p->resolve(p->context, word, out, p->fault);
    *p->fault = kept;
    return known;
}

/* Takes `text` if it stands next, blanks between its characters passed over. */
static bool take(parser *p, const char *text)
{
    size_t start = p->at;
    for (; *text; text++) {
        if (nh_parse_peek(p) != *text) return p->at = start, false;
        p->at++;
    }
    return !isalnum((unsigned char)p->text[p->at]) || text[-1] == ')' || text[-1] == '(' || (p->at = start, false);
}

/* Behind x: is it x(t)? */
static bool take_time(parser *p) { return p->text[p->at] == '(' && take(p, "(t)"); }

/* The rate of `name`, which has room for a prime; where there is none, p->fault says why. */
static bool rate_of(parser *p, char *name, nh_ex *out)
{
    p->fault->what[0] = p->fault->hint[0] = 0;
    return p->resolve(p->context, strcat(name, "'"), out, p->fault);
}

/* diff(x, t), Derivative(x(t), t), behind the first word. */
static bool derivative(parser *p, const char *word, nh_ex *out)
{
    static const char *const words[] = {"diff", "Derivative", "derivative", "D"};
    bool any = false;
    char name[NH_PARSE_NAME + 3];
    size_t start = p->at;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) any |= !strcmp(word, words[i]);
    if (!any || !take(p, "(")) return false;
    nh_parse_peek(p);
    p->at += nh_name_spelled(p->text + p->at, name, NH_PARSE_NAME + 1);
    take_time(p);
    bool good = take(p, ",t)") && rate_of(p, name, out);
    if (!good) p->at = start;
    return good;
}

/* dx/dt: behind "dx". */
static bool quotient_of_differentials(parser *p, const char *word, nh_ex *out)
{
    char name[NH_PARSE_NAME + 4];
    nh_ex taken;
    size_t start = p->at;
    if (*word != 'd' || !word[1] || strchr(word, '\'') || knows(p, "dt", &taken)) return false;
    snprintf(name, sizeof name, "%s", word + 1);
    take_time(p);
    if (take(p, "/dt") && rate_of(p, name, out)) return true;
    return p->at = start, false;
}

/* ---- names ---- */

/* mgl: may be a product of names that are known, or sinx a call; `out` gets it. */
static bool factors_of(parser *p, const char *word, size_t parts, char *out, size_t room)
{
    enum { most_parts = 8 };
    char head[NH_PARSE_NAME + 3];
    size_t length = strlen(word), used = strlen(out);
    nh_ex any;
    if (!length) return parts > 1;
    for (size_t n = length; n > 0 && parts < most_parts; n--) {
        if (word[n] == '\'' || isdigit((unsigned char)word[n])) continue;
        snprintf(head, sizeof head, "%.*s", (int)n, word);
        if (used + n + 2 > room || !(isalpha((unsigned char)*head)) || (n == length && !parts)) continue;
        size_t stem = strcspn(head, "'"); /* xx is a misspelt x */
        if (used >= stem && !strncmp(out + used - stem, head, stem) && parts) continue;
        if (!knows(p, head, &any)) continue;
        snprintf(out + used, room - used, "%s%s", parts ? "*" : "", head);
        if (factors_of(p, word + n, parts + 1, out, room)) return true;
        out[used] = 0;
    }
    return false;
}

static bool propose_factors(parser *p, const char *word, size_t at)
{
    enum { longest = 24 };
    char out[2 * NH_PARSE_NAME + 8] = "";
    nh_function f;
    nh_ex any;
    if (strlen(word) > longest) return false;
    for (size_t n = 2; n < strlen(word); n++) {
        char head[NH_PARSE_NAME + 3];
        snprintf(head, sizeof head, "%.*s", (int)n, word);
        if (nh_name_is_function(head, &f) && nh_function_arity(f) == 1 && knows(p, word + n, &any)) {
            snprintf(out, sizeof out, "%s(%s)", head, word + n);
            return nh_parse_propose(p, at, nh_parse_token_end(p), out), true;
        }
    }
    for (size_t n = 1; nh_parse_peek(p) == '(' && n < strlen(word); n++) { /* msin(x) */
        char head[NH_PARSE_NAME + 3];
        snprintf(head, sizeof head, "%.*s", (int)n, word);
        bool function = nh_name_is_function(word + n, &f) || !strcmp(word + n, "sqrt");
        if (!function || !knows(p, head, &any)) continue;
        snprintf(out, sizeof out, "%s*%s", head, word + n);
        return nh_parse_propose(p, at, nh_parse_token_end(p), out), true;
    }
    return factors_of(p, word, 0, out, sizeof out) && (nh_parse_propose(p, at, nh_parse_token_end(p), out), true);
}

/* A dot on the first letter alone, as of xc, is read x' c: is xc' known? */
static bool propose_prime_behind(parser *p, size_t at)
{
    char head[NH_PARSE_NAME + 4], tail[NH_PARSE_NAME + 2], rate[2 * NH_PARSE_NAME + 8];
    size_t begin = at, end;
    nh_ex any;
    if (begin && p->text[begin - 1] == '\'')
        while (begin && (isalnum((unsigned char)p->text[begin - 1]) || strchr("_'", p->text[begin - 1]))) begin--;
    end = begin + nh_name_spelled(p->text + begin, head, sizeof head - 2);
    if (p->text[end] != '\'') return false;
    size_t n = nh_name_spelled(p->text + end + 1, tail, sizeof tail - 1);
    snprintf(rate, sizeof rate, "%s%s'", head, tail);
    return n && knows(p, rate, &any) && (nh_parse_propose(p, begin, end + 1 + n, rate), true);
}

/* The caller does not know the name, or has explained why it cannot stand here. */
static bool unresolved(parser *p, const char *word, size_t at)
{
    nh_parse_fault *fault = p->fault;
    bool rate = !strncmp(fault->what, "unknown name", strlen("unknown name")) && strstr(fault->what, "'`") &&
                !strchr(word, '\''); /* of a_dot, da/dt or diff(a, t), a' is what is not known */
    bool unknown = !rate && (!fault->what[0] || !strncmp(fault->what, "unknown name", strlen("unknown name"))),
         called = nh_parse_peek(p) == '(';
    fault->offset = at;
    if (unknown) snprintf(fault->what, sizeof fault->what, "unknown %s `%s`", called ? "function" : "name", word);
    bool applied = called || (p->at > nh_parse_token_end(p) && nh_parse_begins_name(p)); /* ln x */
    const char *instead = unknown && applied ? nh_function_elsewhere(word) : NULL,
               *near = unknown && called ? nh_function_nearest(word) : NULL; /* nearer than a coordinate s to sn(x) */
    if (instead) return nh_parse_hint(p, "%s", instead);
    if (unknown && (propose_prime_behind(p, at) || propose_factors(p, word, at))) return false;
    if (near) return nh_parse_hint(p, "did you mean `%s`?", near);
    if (!unknown || !called || !strncmp(fault->hint, "did you mean", strlen("did you mean"))) return false;
    return nh_parse_hint(p,
                         "the functions are: " NH_ELEMENTARY_WORDS "atan2 sqrt abs, those of `nhsym explain "
                         "functions`, and those that a system declares: functions: [\"%.40s(x)\"]",
                         word);
}

/* Does a parenthesis with a single name stand here, where blanks are passed over: (x)?  *end: behind it. */
static bool single_name(const parser *p, size_t *end)
{
    char word[NH_PARSE_NAME + 2];
    size_t at = p->at + strspn(p->text + p->at, " ");
    if (p->text[at++] != '(') return false;
    at += nh_name_spelled(p->text + at, word, sizeof word);
    at += p->text[at] == '\'';
    *end = at + 1;
    return is_letter(*word) && p->text[at] == ')';
}

/* Behind a name that is known: x(t) is x.  A parenthesis is a product where a blank is before it, unless it could be
 * the argument of a function, as in V (x) and theta (t). */
static bool behind_name(parser *p, const char *word, nh_ex *out)
{
    char rate[NH_PARSE_NAME + 4];
    size_t at = p->at, open = at + strspn(p->text + at, " "), end = 0;
    nh_ex any;
    if (p->text[open] != '(') return true;
    snprintf(rate, sizeof rate, "%s'", word);
    bool moves = strchr(word, '\'') || knows(p, rate, &any), named = single_name(p, &end);
    bool timed = moves && named && !strncmp(p->text + open, "(t)", 3), defined = nh_kind_of(p->dag, *out) != NH_SYMBOL;
    if (open == at && moves && take_time(p)) return p->fault->ordinary = true;
    bool call = timed || (moves && named && defined);
    if (open > at && !call) return true;
    nh_parse_fail(p, open, "`%s` is not a function: a product with a parenthesis has a sign or a blank between", word);
    if (!call) return nh_parse_propose(p, at, open, "*");
    return nh_parse_propose_two(p, (nh_parse_change){at, end, ""}, (nh_parse_change){at, open, "*"});
}

/* Reads a name that is not the language's own: the caller resolves it. */
static bool resolved(parser *p, const char *word, size_t at, nh_ex *out)
{
    nh_parse_fault *fault = p->fault;
    fault->what[0] = fault->hint[0] = 0;
    if (!p->resolve(p->context, word, out, fault)) {
        bool unit = !strcmp(word, "deg");
        if (!derivative(p, word, out) && !quotient_of_differentials(p, word, out) && !unit)
            return unresolved(p, word, at);
        fault->ordinary = true;
        if (!unit) return true;
        *out = nh_mul(p->dag, nh_pi(p->dag), nh_ratio(p->dag, 1, 180));
        return true;
    }
    return behind_name(p, word, out);
}

bool nh_parse_name(parser *p, nh_ex *out)
{
    size_t declared, start = p->at;
    char word[NH_PARSE_NAME + 3];
    p->at += nh_name_spelled(p->text + start, word, NH_PARSE_NAME + 2);
    if (strlen(word) > NH_PARSE_NAME) return nh_parse_fail(p, start, "a name longer than %d characters", NH_PARSE_NAME);
    nh_function f = NH_SIN;
    if (nh_declared_find(p->dag, word, &declared)) return declared_call(p, word, declared, out);
    size_t order;
    if (nh_declared_find_partial(p->dag, word, &declared, &order)) return table_call(p, word, declared, order, out);
    bool root = !strcmp(word, "sqrt");
    if (root || nh_name_is_function(word, &f)) return function(p, f, root, word, start, out);
    if (!strcmp(word, "pi")) {
        *out = nh_pi(p->dag);
        return true;
    }
    if (p->text[p->at] == '\'') {
        strcat(word, "'");
        p->at++;
        if (p->text[p->at] == '\'')
            return nh_parse_fail(
                p, start, "second derivatives cannot be used: a system is written with coordinates and velocities");
    }
    return resolved(p, word, start, out);
}
