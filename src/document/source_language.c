/* source_language: the table of languages. */
#include "document/source.h"

#define FUNCTIONS(p, arc, arc2, hyper) \
    [NH_SIN] = p "sin", [NH_COS] = p "cos", [NH_TAN] = p "tan", [NH_ASIN] = p arc "sin", [NH_ACOS] = p arc "cos", \
    [NH_ATAN] = p arc "tan", [NH_SINH] = p "sinh", [NH_COSH] = p "cosh", [NH_TANH] = p "tanh", \
    [NH_ASINH] = p hyper "sinh", [NH_ACOSH] = p hyper "cosh", [NH_ATANH] = p hyper "tanh", [NH_EXP] = p "exp", \
    [NH_LOG] = p "log", [NH_ATAN2] = p arc2

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
                "nh_sign nh_solve isfinite fmax last_ change_ step_ i_ ",
    .call = {FUNCTIONS("", "a", "atan2", "a"), [NH_ABS] = "fabs", [NH_SIGN] = "nh_sign"},
    .root = "sqrt",
    .pi = "3.141592653589793",
    .power = {"pow(", ", ", ")"},
    .declare = "const double ",
    .end = ";",
    .point = true,
    .products = true};

#define PYTHON_WORDS \
    " False None True and as assert async await break class continue def del elif else except finally for from " \
    "global if import in is lambda nonlocal not or " \
    "pass raise return try while with yield match case type print range len abs float "

const nh_source_language nh_source_python = {
    .name = "python",
    .reserved = PYTHON_WORDS "np _array _solve _small last_ change_ step_ namedtuple ",
    .call = {FUNCTIONS("np.", "arc", "arctan2", "arc"), [NH_ABS] = "np.abs", [NH_SIGN] = "np.sign"},
    .root = "np.sqrt",
    .pi = "np.pi",
    .power = {"", "**", ""},
    .declare = "",
    .end = ""};

const nh_source_language nh_source_sympy = {
    .name = "sympy",
    .reserved = PYTHON_WORDS "sp _array _solve _small namedtuple ",
    .call = {FUNCTIONS("sp.", "a", "atan2", "a"), [NH_ABS] = "sp.Abs", [NH_SIGN] = "sp.sign"},
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
                "nargin norm max error struct ans varargin varargout nargout last_ change_ step_ Inf api ",
    .call = {FUNCTIONS("", "a", "atan2", "a"), [NH_ABS] = "abs", [NH_SIGN] = "sign"},
    .root = "sqrt",
    .pi = "pi",
    .power = {"", "^", ""},
    .declare = "",
    .end = ";"};

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
