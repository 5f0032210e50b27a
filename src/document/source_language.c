/* source_language: the table of languages. */
#include "document/source.h"
#include "graph/function.h"

#define FUNCTIONS(p, arc, arc2, hyper)                                                                                 \
    [NH_SIN] = p "sin", [NH_COS] = p "cos", [NH_TAN] = p "tan", [NH_ASIN] = p arc "sin", [NH_ACOS] = p arc "cos",      \
    [NH_ATAN] = p arc "tan", [NH_SINH] = p "sinh", [NH_COSH] = p "cosh", [NH_TANH] = p "tanh",                         \
    [NH_ASINH] = p hyper "sinh", [NH_ACOSH] = p hyper "cosh", [NH_ATANH] = p hyper "tanh", [NH_EXP] = p "exp",         \
    [NH_LOG] = p "log", [NH_ATAN2] = p arc2

/* Named functions.  GSL's are those of gsl/gsl_sf.h: Bessel functions need n >= 0 and x > 0, 2F1 needs |x| < 1; its
 * 2F1_conj takes real and imaginary part of a and of b, the conjugate.  Derivatives are written by functions of
 * neighbouring orders [DLMF 10.6, 10.29, 13.3, 14.10, 15.5]. */
#define AI "gsl_sf_airy_Ai"
#define BI "gsl_sf_airy_Bi"
#define P0 ", GSL_PREC_DOUBLE)"
#define CONJUGATE(s, p, c, x)                                                                                          \
    "(4*(" p ") > (" s ")*(" s ") ? gsl_sf_hyperg_2F1_conj((" s ")/2, sqrt((" p ") - (" s ")*(" s ")/4), " c ", " x    \
    ") : "                                                                                                             \
    "gsl_sf_hyperg_2F1((" s ")/2 + sqrt((" s ")*(" s ")/4 - (" p ")), (" s ")/2 - sqrt((" s ")*(" s ")/4 - (" p        \
    ")), " c ", " x "))"
/* Riemann's equation has a function of its own (SERIES): y'' = (a + b z + c z^2)/(1 + z^2)^2 y by Taylor series from 0
 * to x, y and y' at 0 given. */
#define SERIES_C                                                                                                       \
    "/* y'' = (a + b z + c z^2)/(1 + z^2)^2 y by Taylor series from 0 to x. */\n"                                      \
    "static double nh_series(double a, double b, double c, double x, double y, double v, int slope)\n{\n"              \
    "    double z = 0;\n"                                                                                              \
    "    if (!isfinite(x)) return x - x;\n"                                                                            \
    "    while (z != x) {\n"                                                                                           \
    "        double u[40], e = 1 + z*z, reach = 0.3*sqrt(e), h = x - z, value = 0, rate = 0;\n"                        \
    "        int k, last = fabs(h) <= reach;\n"                                                                        \
    "        if (!last) h = h > 0 ? reach : -reach;\n"                                                                 \
    "        u[0] = y;\n"                                                                                              \
    "        u[1] = v;\n"                                                                                              \
    "        for (k = 0; k < 38; k++) {\n"                                                                             \
    "            double s = (a + (b + c*z)*z - (4*z*z + 2*e)*k*(k - 1))*u[k] - 4*e*z*(k + 1)*k*u[k + 1];\n"            \
    "            if (k > 0) s += (b + 2*c*z - 4*z*(k - 1)*(k - 2))*u[k - 1];\n"                                        \
    "            if (k > 1) s += (c - (k - 2)*(k - 3))*u[k - 2];\n"                                                    \
    "            u[k + 2] = s/(e*e*(k + 2)*(k + 1));\n"                                                                \
    "        }\n"                                                                                                      \
    "        for (k = 39; k >= 0; k--) {\n"                                                                            \
    "            rate = rate*h + value;\n"                                                                             \
    "            value = value*h + u[k];\n"                                                                            \
    "        }\n"                                                                                                      \
    "        y = value;\n"                                                                                             \
    "        v = rate;\n"                                                                                              \
    "        z = last ? x : z + h;\n"                                                                                  \
    "    }\n"                                                                                                          \
    "    return slope ? v : y;\n}\n\n"
#define SERIES(f)                                                                                                      \
    [NH_RIEMANN_C] = f "($1, $2, $3, $4, 1, 0, 0)", [NH_RIEMANN_C_PRIME] = f "($1, $2, $3, $4, 1, 0, 1)",              \
    [NH_RIEMANN_S] = f "($1, $2, $3, $4, 0, 1, 0)", [NH_RIEMANN_S_PRIME] = f "($1, $2, $3, $4, 0, 1, 1)"
#define GSL                                                                                                            \
    {                                                                                                                  \
        [NH_LEGENDRE_P] = "gsl_sf_hyperg_2F1(-$1, $1 + 1, 1, (1 - $2)/2)",                                             \
        [NH_LEGENDRE_P_PRIME] = "($1*($1 + 1)/2*gsl_sf_hyperg_2F1(1 - $1, $1 + 2, 2, (1 - $2)/2))",                    \
        [NH_HYP2F1] = "gsl_sf_hyperg_2F1($1, $2, $3, $4)",                                                             \
        [NH_HYP2F1_PRIME] = "($1*$2/$3*gsl_sf_hyperg_2F1($1 + 1, $2 + 1, $3 + 1, $4))",                                \
        [NH_GAUSS_F] = CONJUGATE("$1", "$2", "$3", "$4"),                                                              \
        [NH_GAUSS_F_PRIME] = "($2/$3*" CONJUGATE("$1 + 2", "$2 + $1 + 1", "$3 + 1", "$4") ")",                         \
        SERIES("nh_series"), [NH_HYP1F1] = "gsl_sf_hyperg_1F1($1, $2, $3)",                                            \
        [NH_HYP1F1_PRIME] = "($1/$2*gsl_sf_hyperg_1F1($1 + 1, $2 + 1, $3))",                                           \
        [NH_HYPERU] = "gsl_sf_hyperg_U($1, $2, $3)", [NH_HYPERU_PRIME] = "(-$1*gsl_sf_hyperg_U($1 + 1, $2 + 1, $3))",  \
        [NH_BESSEL_J] = "gsl_sf_bessel_Jnu($1, $2)",                                                                   \
        [NH_BESSEL_J_PRIME] = "($1/$2*gsl_sf_bessel_Jnu($1, $2) - gsl_sf_bessel_Jnu($1 + 1, $2))",                     \
        [NH_BESSEL_Y] = "gsl_sf_bessel_Ynu($1, $2)",                                                                   \
        [NH_BESSEL_Y_PRIME] = "($1/$2*gsl_sf_bessel_Ynu($1, $2) - gsl_sf_bessel_Ynu($1 + 1, $2))",                     \
        [NH_BESSEL_I] = "gsl_sf_bessel_Inu($1, $2)",                                                                   \
        [NH_BESSEL_I_PRIME] = "($1/$2*gsl_sf_bessel_Inu($1, $2) + gsl_sf_bessel_Inu($1 + 1, $2))",                     \
        [NH_BESSEL_K] = "gsl_sf_bessel_Knu($1, $2)",                                                                   \
        [NH_BESSEL_K_PRIME] = "($1/$2*gsl_sf_bessel_Knu($1, $2) - gsl_sf_bessel_Knu($1 + 1, $2))",                     \
        [NH_AIRY_AI] = AI "($1" P0, [NH_AIRY_AI_PRIME] = AI "_deriv($1" P0, [NH_AIRY_BI] = BI "($1" P0,                \
        [NH_AIRY_BI_PRIME] = BI "_deriv($1" P0, [NH_ELLIPTIC_K] = "gsl_sf_ellint_Kcomp(sqrt($1)" P0,                   \
        [NH_ELLIPTIC_E] = "gsl_sf_ellint_Ecomp(sqrt($1)" P0, [NH_ELLIPTIC_F] = "gsl_sf_ellint_F($1, sqrt($2)" P0,      \
        [NH_ELLIPTIC_EINC] = "gsl_sf_ellint_E($1, sqrt($2)" P0,                                                        \
        [NH_ELLIPTIC_PI] = "gsl_sf_ellint_P($2, sqrt($3), -($1)" P0                                                    \
    }

#define MP(arguments, value, places) "np.vectorize(lambda " arguments ": float(_mp.re(" value ")))(" places ")"
#define MP_GAUSS(places)                                                                                               \
    MP("s, p, c, x", "_mp.hyp2f1(s/2 + _mp.sqrt(s**2/4 - p), s/2 - _mp.sqrt(s**2/4 - p), c, x)", places)
#define SERIES_PYTHON                                                                                                  \
    "\n\n@np.vectorize\n"                                                                                              \
    "def _series(a, b, c, x, y, v, slope):\n"                                                                          \
    "    \"\"\"y'' = (a + b z + c z^2)/(1 + z^2)^2 y by Taylor series from 0 to x.\"\"\"\n"                            \
    "    z, y, v = 0.0, float(y), float(v)\n"                                                                          \
    "    if not np.isfinite(x):\n"                                                                                     \
    "        return np.nan\n"                                                                                          \
    "    while z != x:\n"                                                                                              \
    "        e, h, u = 1 + z*z, x - z, [y, v]\n"                                                                       \
    "        last = abs(h) <= 0.3*np.sqrt(e)\n"                                                                        \
    "        if not last:\n"                                                                                           \
    "            h = np.copysign(0.3*np.sqrt(e), h)\n"                                                                 \
    "        for k in range(38):\n"                                                                                    \
    "            s = (a + (b + c*z)*z - (4*z*z + 2*e)*k*(k - 1))*u[k] - 4*e*z*(k + 1)*k*u[k + 1]\n"                    \
    "            if k > 0:\n"                                                                                          \
    "                s += (b + 2*c*z - 4*z*(k - 1)*(k - 2))*u[k - 1]\n"                                                \
    "            if k > 1:\n"                                                                                          \
    "                s += (c - (k - 2)*(k - 3))*u[k - 2]\n"                                                            \
    "            u.append(s/(e*e*(k + 2)*(k + 1)))\n"                                                                  \
    "        y = v = 0.0\n"                                                                                            \
    "        for k in range(39, -1, -1):\n"                                                                            \
    "            y, v = y*h + u[k], v*h + y\n"                                                                         \
    "        z = x if last else z + h\n"                                                                               \
    "    return v if slope else y\n"
#define SCIPY                                                                                                          \
    {                                                                                                                  \
        [NH_LEGENDRE_P] = "_sf.hyp2f1(-$1, $1 + 1, 1, (1 - $2)/2)",                                                    \
        [NH_LEGENDRE_P_PRIME] = "($1*($1 + 1)/2*_sf.hyp2f1(1 - $1, $1 + 2, 2, (1 - $2)/2))",                           \
        [NH_LEGENDRE_Q] = MP("n, x", "_mp.legenq(n, 0, x, type=2)", "$1, $2"),                                         \
        [NH_LEGENDRE_Q_PRIME] = MP("n, x", "_mp.diff(lambda y: _mp.legenq(n, 0, y, type=2), x)", "$1, $2"),            \
        [NH_HYP2F1] = "_sf.hyp2f1($1, $2, $3, $4)",                                                                    \
        [NH_HYP2F1_PRIME] = "($1*$2/$3*_sf.hyp2f1($1 + 1, $2 + 1, $3 + 1, $4))",                                       \
        [NH_GAUSS_F] = MP_GAUSS("$1, $2, $3, $4"),                                                                     \
        [NH_GAUSS_F_PRIME] = "($2/$3*" MP_GAUSS("$1 + 2, $2 + $1 + 1, $3 + 1, $4") ")", SERIES("_series"),             \
        [NH_HYP1F1] = "_sf.hyp1f1($1, $2, $3)", [NH_HYP1F1_PRIME] = "($1/$2*_sf.hyp1f1($1 + 1, $2 + 1, $3))",          \
        [NH_HYPERU] = "_sf.hyperu($1, $2, $3)", [NH_HYPERU_PRIME] = "(-$1*_sf.hyperu($1 + 1, $2 + 1, $3))",            \
        [NH_BESSEL_J] = "_sf.jv($1, $2)", [NH_BESSEL_J_PRIME] = "_sf.jvp($1, $2)", [NH_BESSEL_Y] = "_sf.yv($1, $2)",   \
        [NH_BESSEL_Y_PRIME] = "_sf.yvp($1, $2)", [NH_BESSEL_I] = "_sf.iv($1, $2)",                                     \
        [NH_BESSEL_I_PRIME] = "_sf.ivp($1, $2)", [NH_BESSEL_K] = "_sf.kv($1, $2)",                                     \
        [NH_BESSEL_K_PRIME] = "_sf.kvp($1, $2)", [NH_AIRY_AI] = "_sf.airy($1)[0]",                                     \
        [NH_AIRY_AI_PRIME] = "_sf.airy($1)[1]", [NH_AIRY_BI] = "_sf.airy($1)[2]",                                      \
        [NH_AIRY_BI_PRIME] = "_sf.airy($1)[3]", [NH_ELLIPTIC_K] = "_sf.ellipk($1)",                                    \
        [NH_ELLIPTIC_E] = "_sf.ellipe($1)", [NH_ELLIPTIC_F] = "_sf.ellipkinc($1, $2)",                                 \
        [NH_ELLIPTIC_EINC] = "_sf.ellipeinc($1, $2)",                                                                  \
        [NH_ELLIPTIC_PI] = MP("n, u, m", "_mp.ellippi(n, u, m)", "$1, $2, $3")                                         \
    }

#define SP_GAUSS(s, p, c, x)                                                                                           \
    "sp.hyper((sp.S(" s ")/2 + sp.sqrt(sp.S(" s ")**2/4 - (" p ")), sp.S(" s ")/2 - sp.sqrt(sp.S(" s ")**2/4 - (" p    \
    "))), (" c ",), " x ")"
#define SYMPY                                                                                                          \
    {                                                                                                                  \
        [NH_LEGENDRE_P] = "sp.legendre($1, $2)",                                                                       \
        [NH_LEGENDRE_P_PRIME] = "($1*($2*sp.legendre($1, $2) - sp.legendre($1 - 1, $2))/($2**2 - 1))",                 \
        [NH_HYP2F1] = "sp.hyper(($1, $2), ($3,), $4)",                                                                 \
        [NH_HYP2F1_PRIME] = "(sp.S($1)*$2/$3*sp.hyper(($1 + 1, $2 + 1), ($3 + 1,), $4))",                              \
        [NH_GAUSS_F] = SP_GAUSS("$1", "$2", "$3", "$4"),                                                               \
        [NH_GAUSS_F_PRIME] = "(sp.S($2)/$3*" SP_GAUSS("$1 + 2", "$2 + $1 + 1", "$3 + 1", "$4") ")",                    \
        [NH_HYP1F1] = "sp.hyper(($1,), ($2,), $3)",                                                                    \
        [NH_HYP1F1_PRIME] = "(sp.S($1)/$2*sp.hyper(($1 + 1,), ($2 + 1,), $3))", [NH_BESSEL_J] = "sp.besselj($1, $2)",  \
        [NH_BESSEL_J_PRIME] = "((sp.besselj($1 - 1, $2) - sp.besselj($1 + 1, $2))/2)",                                 \
        [NH_BESSEL_Y] = "sp.bessely($1, $2)",                                                                          \
        [NH_BESSEL_Y_PRIME] = "((sp.bessely($1 - 1, $2) - sp.bessely($1 + 1, $2))/2)",                                 \
        [NH_BESSEL_I] = "sp.besseli($1, $2)",                                                                          \
        [NH_BESSEL_I_PRIME] = "((sp.besseli($1 - 1, $2) + sp.besseli($1 + 1, $2))/2)",                                 \
        [NH_BESSEL_K] = "sp.besselk($1, $2)",                                                                          \
        [NH_BESSEL_K_PRIME] = "(-(sp.besselk($1 - 1, $2) + sp.besselk($1 + 1, $2))/2)",                                \
        [NH_AIRY_AI] = "sp.airyai($1)", [NH_AIRY_AI_PRIME] = "sp.airyaiprime($1)", [NH_AIRY_BI] = "sp.airybi($1)",     \
        [NH_AIRY_BI_PRIME] = "sp.airybiprime($1)", [NH_ELLIPTIC_K] = "sp.elliptic_k($1)",                              \
        [NH_ELLIPTIC_E] = "sp.elliptic_e($1)", [NH_ELLIPTIC_F] = "sp.elliptic_f($1, $2)",                              \
        [NH_ELLIPTIC_EINC] = "sp.elliptic_e($1, $2)", [NH_ELLIPTIC_PI] = "sp.elliptic_pi($1, $2, $3)"                  \
    }

#define OCTAVE                                                                                                         \
    {                                                                                                                  \
        [NH_BESSEL_J] = "besselj($1, $2)", [NH_BESSEL_J_PRIME] = "((besselj($1 - 1, $2) - besselj($1 + 1, $2))/2)",    \
        [NH_BESSEL_Y] = "bessely($1, $2)", [NH_BESSEL_Y_PRIME] = "((bessely($1 - 1, $2) - bessely($1 + 1, $2))/2)",    \
        [NH_BESSEL_I] = "besseli($1, $2)", [NH_BESSEL_I_PRIME] = "((besseli($1 - 1, $2) + besseli($1 + 1, $2))/2)",    \
        [NH_BESSEL_K] = "besselk($1, $2)", [NH_BESSEL_K_PRIME] = "(-(besselk($1 - 1, $2) + besselk($1 + 1, $2))/2)",   \
        [NH_AIRY_AI] = "airy(0, $1)", [NH_AIRY_AI_PRIME] = "airy(1, $1)", [NH_AIRY_BI] = "airy(2, $1)",                \
        [NH_AIRY_BI_PRIME] = "airy(3, $1)", [NH_ELLIPTIC_K] = "ellipke($1)"                                            \
    }

const nh_source_language nh_source_c = {
    .name = "c",
    /* C99, C11, C23, C++ to C++20, macros of <math.h> and of compilers, and the functions that the code calls */
    .reserved = " auto break case char const continue default do double else enum extern float for goto if inline int "
                "long register restrict return short signed sizeof static struct "
                "switch typedef union unsigned void volatile while alignas alignof bool constexpr false nullptr "
                "static_assert thread_local true typeof typeof_unqual asm "
                "and and_eq bitand bitor catch char8_t char16_t char32_t class co_await co_return co_yield compl "
                "concept const_cast consteval constinit decltype delete dynamic_cast "
                "explicit export friend import module mutable namespace new noexcept not not_eq operator or or_eq "
                "private protected public reinterpret_cast requires static_cast "
                "template this throw try typeid typename using virtual wchar_t xor xor_eq "
                "linux unix i386 NAN INFINITY HUGE_VAL HUGE NULL DOMAIN SING OVERFLOW UNDERFLOW PLOSS TLOSS EOF I "
                "sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh exp log sqrt fabs atan2 pow memset memcpy "
                "nh_sign nh_solve nh_series isfinite fmax last_ change_ size_ step_ i_ ",
    .call = {FUNCTIONS("", "a", "atan2", "a"), [NH_ABS] = "fabs", [NH_SIGN] = "nh_sign"},
    .named = GSL,
    .library = {{"gsl_sf_", "#include <gsl/gsl_sf.h>\n"}},
    .series = {"nh_series(", SERIES_C},
    .root = "sqrt",
    .pi = "3.141592653589793",
    .power = {"pow(", ", ", ")"},
    .declare = "const double ",
    .end = ";",
    .point = true,
    .products = true};

#define PYTHON_WORDS                                                                                                   \
    " False None True and as assert async await break class continue def del elif else except finally for from "       \
    "global if import in is lambda nonlocal not or "                                                                   \
    "pass raise return try while with yield match case type print range len abs float "

const nh_source_language nh_source_python = {
    .name = "python",
    .reserved = PYTHON_WORDS "np _sf _mp _series _array _solve _small last_ small_ done_ step_ namedtuple ",
    .call = {FUNCTIONS("np.", "arc", "arctan2", "arc"), [NH_ABS] = "np.abs", [NH_SIGN] = "np.sign"},
    .named = SCIPY,
    .library = {{"_mp.", "import mpmath as _mp\n"}, {"_sf.", "from scipy import special as _sf\n"}},
    .series = {"_series(", SERIES_PYTHON},
    .root = "np.sqrt",
    .pi = "np.pi",
    .power = {"", "**", ""},
    .declare = "",
    .end = ""};

const nh_source_language nh_source_sympy = {
    .name = "sympy",
    .reserved = PYTHON_WORDS "sp _array _solve _small namedtuple ",
    .call = {FUNCTIONS("sp.", "a", "atan2", "a"), [NH_ABS] = "sp.Abs", [NH_SIGN] = "sp.sign"},
    .named = SYMPY,
    .root = "sp.sqrt",
    .pi = "sp.pi",
    .power = {"", "**", ""},
    .declare = "",
    .end = "",
    .fraction = {"sp.Rational(", ", ", ")"},
    .exact = true};

const nh_source_language nh_source_matlab = {
    .name = "matlab",
    .reserved = " break case catch classdef continue else elseif end for function global if otherwise parfor "
                "persistent return spmd switch try while arguments methods properties events "
                "enumeration import end_try_catch end_unwind_protect endfor endfunction endif endparfor endswitch "
                "endwhile endclassdef endenumeration endevents endmethods endproperties "
                "unwind_protect unwind_protect_cleanup until do __FILE__ __LINE__ "
                "sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh exp log sqrt abs atan2 sign zeros numel "
                "besselj bessely besseli besselk airy ellipke "
                "nargin norm max error struct ans varargin varargout nargout last_ change_ size_ step_ Inf api ",
    .call = {FUNCTIONS("", "a", "atan2", "a"), [NH_ABS] = "abs", [NH_SIGN] = "sign"},
    .named = OCTAVE,
    .root = "sqrt",
    .pi = "pi",
    .power = {"", "^", ""},
    .declare = "",
    .end = ";"};

/* Elliptic integrals and Riemann's equation are functions of page/special.js. */
#define JS(f) "nhsymSpecial." f
#define JAVASCRIPT                                                                                                     \
    {                                                                                                                  \
        [NH_ELLIPTIC_K] = JS("ellipticF(Math.PI/2, $1)"), [NH_ELLIPTIC_E] = JS("ellipticE(Math.PI/2, $1)"),            \
        [NH_ELLIPTIC_F] = JS("ellipticF($1, $2)"), [NH_ELLIPTIC_EINC] = JS("ellipticE($1, $2)"),                       \
        [NH_ELLIPTIC_PI] = JS("ellipticPi($1, $2, $3)"), SERIES(JS("series"))                                          \
    }

const nh_source_language nh_source_js = {
    .name = "JavaScript",
    .reserved =
        " arguments async await break case catch class const continue debugger default delete do else enum eval "
        "export extends false finally for function if implements import in instanceof interface let new null of "
        "package private protected public return static super switch this throw true try typeof undefined var "
        "void while with yield Math NaN Infinity Number Array Object window document nhsymLinear nhsymSpecial ",
    .call = {FUNCTIONS("Math.", "a", "atan2", "a"), [NH_ABS] = "Math.abs", [NH_SIGN] = "Math.sign"},
    .named = JAVASCRIPT,
    .root = "Math.sqrt",
    .pi = "Math.PI",
    .power = {"Math.pow(", ", ", ")"},
    .declare = "const ",
    .end = ";",
    .products = true};

const nh_source_language nh_source_plain = {
    .name = "plain",
    .reserved = " t pi sqrt sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh exp log abs sign atan2 ",
    .call = {FUNCTIONS("", "a", "atan2", "a"), [NH_ABS] = "abs", [NH_SIGN] = "sign"},
    .root = "sqrt",
    .pi = "pi",
    .power = {"", "^", ""},
    .declare = "",
    .end = "",
    .exact = true,
    .plain = true};
