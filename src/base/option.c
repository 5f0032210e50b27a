#include "base/option.h"

#include <math.h>
#include <string.h>

#include "base/text.h"

static const nh_option_row table[] = {
#define X(name, value, low, high, kind, unit, doc) {#name, unit, doc, value, low, high, NH_OPTION_##kind},
    NH_OPTION_TABLE(X)
#undef X
};
enum { count = sizeof table / sizeof *table };

size_t nh_option_count(void) { return count; }
nh_option_row nh_option_at(size_t index) { return table[index]; }

void nh_options_default(nh_options *options)
{
    *options = (nh_options){
#define X(name, value, low, high, kind, unit, doc) value,
        NH_OPTION_TABLE(X)
#undef X
    };
}

static double *field(nh_options *options, size_t index)
{
    static const size_t offset[] = {
#define X(name, value, low, high, kind, unit, doc) offsetof(nh_options, name),
        NH_OPTION_TABLE(X)
#undef X
    };
    return (double *)((char *)options + offset[index]);
}

const char *nh_option_name(const char *word)
{
#define X(old, name)                                                                                                   \
    if (!strcmp(word, #old)) return #name;
    NH_OPTION_OLD_TABLE(X)
#undef X
    return word;
}

bool nh_options_set(nh_options *options, const char *name, const char *value, nh_error *error)
{
    const char *names[count];
    size_t index = count;
    name = nh_option_name(name);
    for (size_t i = 0; i < count; i++) {
        names[i] = table[i].name;
        if (!strcmp(name, names[i])) index = i;
    }
    if (index == count) {
        nh_fail(error, NH_USAGE, "", "there is no option `%s`", name);
        const char *near = nh_text_nearest(name, names, count);
        return near ? nh_error_hint(error, "did you mean `%s`?", near)
                    : nh_error_hint(error, "`nhsym explain options` lists them");
    }
    double x;
    if (!nh_text_to_number(value, &x)) {
        nh_fail(error, NH_USAGE, "", "the option `%s` needs a number, found `%s`", name, value);
        return nh_error_hint_number(error, value);
    }
    if (!(x >= table[index].low && x <= table[index].high))
        return nh_fail(error, NH_USAGE, "", "the option `%s` must lie between %g and %g, found `%s`", name,
                       table[index].low, table[index].high, value);
    if (table[index].kind == NH_OPTION_whole && x != floor(x))
        return nh_fail(error, NH_USAGE, "", "the option `%s` needs a whole number, found `%s`", name, value);
    *field(options, index) = x;
    return true;
}
