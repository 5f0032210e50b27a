/* error, memory and text. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include <float.h>
#include <math.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/error.h"
#include "base/json.h"
#include "base/memory.h"
#include "base/text.h"

/* ---- error ---- */

Test(error, is_formatted_with_place_excerpt_and_hint)
{
    nh_error error;
    char out[4096];
    nh_error_clear(&error);
    cr_assert_not(nh_fail(&error, NH_INPUT, "mine.yaml:7:14", "unknown name `%s` in an expression", "phii"));
    strcpy(error.excerpt, "  y' = phii\n       ^");
    cr_assert_not(nh_error_hint(&error, "did you mean `%s`?", "phi"));
    nh_error_format(&error, out, sizeof out);
    cr_assert_str_eq(out, "mine.yaml:7:14: unknown name `phii` in an expression\n  y' = phii\n       ^\nhint: did you mean `phi`?");
    cr_assert_eq(error.code, NH_INPUT);
}

Test(error, parts_that_are_empty_leave_no_trace)
{
    nh_error error;
    char out[256];
    nh_error_clear(&error);
    nh_fail(&error, NH_USAGE, NULL, "no system given");
    nh_error_format(&error, out, sizeof out);
    cr_assert_str_eq(out, "no system given");
    nh_error_hint(&error, "try `nhsym list`");
    nh_error_format(&error, out, sizeof out);
    cr_assert_str_eq(out, "no system given\nhint: try `nhsym list`");
    nh_error_clear(&error);
    nh_error_format(&error, out, sizeof out);
    cr_assert_str_eq(out, "");
}

Test(error, keeps_the_first_cause_and_the_first_hint)
{
    nh_error error;
    nh_error_clear(&error);
    nh_fail(&error, NH_NUMERIC, "here", "first");
    nh_fail(&error, NH_INPUT, "there", "second");
    nh_error_hint(&error, "one");
    nh_error_hint(&error, "two");
    cr_assert_eq(error.code, NH_NUMERIC);
    cr_assert_str_eq(error.where, "here");
    cr_assert_str_eq(error.what, "first");
    cr_assert_str_eq(error.hint, "one");
}

Test(error, may_be_null)
{
    cr_assert_not(nh_fail(NULL, NH_INPUT, "x", "y"));
    cr_assert_not(nh_error_hint(NULL, "y"));
    nh_error_clear(NULL);
}

/* 767 bytes fit; "é" has two, so that an odd number of bytes would cut one in two. */
Test(error, cuts_between_characters)
{
    nh_error error;
    char text[2001] = "", out[6];
    for (size_t i = 0; i < 1000; i++)
        memcpy(text + 2 * i, "é", 3);
    nh_error_clear(&error);
    nh_fail(&error, NH_INPUT, "", "%s", text);
    cr_assert_eq(strlen(error.what), sizeof error.what - 2);
    cr_assert_eq(strncmp(error.what, text, sizeof error.what - 2), 0);
    nh_error_format(&error, out, sizeof out);
    cr_assert_str_eq(out, "éé");
    nh_error_format(&error, NULL, 0);
    nh_error_clear(&error);
    nh_fail(&error, NH_INPUT, "", "a€😀");
    static const char *const cut[] = {"", "a", "a", "a", "a€", "a€", "a€", "a€", "a€😀"};
    char whole[9];
    for (size_t size = 1; size <= 9; size++) {
        nh_error_format(&error, whole, size);
        cr_expect_str_eq(whole, cut[size - 1]);
    }
}

Test(error, of_a_long_place_the_line_survives)
{
    nh_error error;
    char path[600];
    memset(path, 'd', sizeof path);
    strcpy(path + 500, "/f.yaml:12:3");
    nh_error_clear(&error);
    nh_fail(&error, NH_INPUT, path, "x");
    cr_assert_eq(strlen(error.where), sizeof error.where - 1);
    cr_assert_eq(strncmp(error.where, "...ddd", 6), 0);
    cr_assert_str_eq(error.where + strlen(error.where) - 12, "/f.yaml:12:3");
}

/* ---- memory ---- */

Test(memory, is_zeroed_and_grows)
{
    unsigned char *bytes = nh_alloc(100);
    for (size_t i = 0; i < 100; i++)
        cr_assert_eq(bytes[i], 0);
    nh_free(bytes);
    void *nothing = nh_alloc(0);
    cr_assert_not_null(nothing);
    nh_free(nothing);
    nh_free(NULL);

    double *list = NULL;
    size_t capacity = 0;
    for (size_t i = 0; i < 1000; i++) {
        nh_grow(&list, &capacity, i + 1, sizeof *list);
        list[i] = 2.385 * (double)i;
    }
    cr_assert_geq(capacity, 1000u);
    cr_assert_leq(capacity, 2000u);
    cr_assert_eq(list[999], 2.385 * 999);
    size_t before = capacity;
    nh_grow(&list, &capacity, 3, sizeof *list);
    cr_assert_eq(capacity, before);
    list = nh_realloc_array(list, 2, sizeof *list);
    cr_assert_eq(list[1], 2.385);
    nh_free(list);

    char *copy = nh_strdup("sleigh");
    cr_assert_str_eq(copy, "sleigh");
    nh_free(copy);
}

static void leave(size_t wanted)
{
    _exit(wanted == SIZE_MAX ? 55 : 56);
}

static void return_anyway(size_t wanted)
{
    (void)wanted;
}

Test(memory, overflow_goes_to_the_handler, .exit_code = 55)
{
    nh_memory_set_handler(leave);
    nh_free(nh_alloc_array(SIZE_MAX / 2, 3));
}

Test(memory, overflow_while_growing_goes_to_the_handler, .exit_code = 55)
{
    double *list = NULL;
    size_t capacity = 0;
    nh_memory_set_handler(leave);
    nh_grow(&list, &capacity, SIZE_MAX / 4, sizeof *list);
    nh_free(list);
}

Test(memory, without_a_handler_aborts, .signal = SIGABRT)
{
    nh_free(nh_alloc_array(SIZE_MAX / 2, 3));
}

Test(memory, a_handler_that_returns_aborts, .signal = SIGABRT)
{
    nh_memory_set_handler(return_anyway);
    nh_free(nh_realloc_array(NULL, SIZE_MAX / 2, 3));
}

#ifndef __SANITIZE_ADDRESS__ /* whose own memory needs an address space without limit */
/* A JSON that lacks what did not fit into memory would be wrong without anybody's notice. */
Test(memory, a_json_without_room_goes_to_the_handler, .exit_code = 56)
{
    nh_memory_set_handler(leave);
    nh_json *root = nh_json_object(), *list = nh_json_put_array(root, "list");
    struct rlimit limit = {1 << 28, 1 << 28};
    cr_assert_eq(setrlimit(RLIMIT_AS, &limit), 0);
    for (int i = 0; i < 10000000; i++) nh_json_add_number(list, i + 0.5);
    nh_free(nh_json_finish(root));
}
#endif

/* Small and large blocks in turn keep their contents and do not overlap. */
Test(memory, an_arena_keeps_what_it_gave)
{
    enum { COUNT = 400 };
    nh_arena *arena = nh_arena_create();
    unsigned char *part[COUNT];
    size_t size[COUNT];
    for (size_t i = 0; i < COUNT; i++) {
        size[i] = i % 17 == 3 ? 5000 + 91 * i : (i * 37) % 300;
        part[i] = nh_arena_alloc(arena, size[i]);
        cr_assert_eq((uintptr_t)part[i] % 16, 0u);
        for (size_t j = 0; j < size[i]; j++)
            cr_assert_eq(part[i][j], 0);
        memset(part[i], (int)(i % 251), size[i]);
    }
    for (size_t i = 0; i < COUNT; i++)
        for (size_t j = 0; j < size[i]; j++)
            cr_assert_eq(part[i][j], i % 251);
    nh_arena_free(arena);
    nh_arena_free(NULL);
}

Test(memory, an_arena_begins_with_a_large_block_too)
{
    nh_arena *arena = nh_arena_create();
    char *large = nh_arena_alloc(arena, 100000), *small = nh_arena_alloc(arena, 10);
    memset(large, 'l', 100000);
    cr_assert_eq(small[0], 0);
    nh_arena_free(arena);
}

Test(memory, an_arena_copies_and_formats_texts)
{
    nh_arena *arena = nh_arena_create();
    cr_assert_str_eq(nh_arena_strdup(arena, "x' = v"), "x' = v");
    cr_assert_str_eq(nh_arena_strndup(arena, "x' = v", 2), "x'");
    cr_assert_str_eq(nh_arena_strndup(arena, NULL, 0), "");
    cr_assert_str_eq(nh_arena_printf(arena, "%s = %d", "k", 12), "k = 12");
    cr_assert_str_eq(nh_arena_printf(arena, "%s", ""), "");
    const char *wide = nh_arena_printf(arena, "%20000d", 7);
    cr_assert_eq(strlen(wide), 20000u);
    cr_assert_eq(wide[19999], '7');
    nh_arena_free(arena);
}

/* ---- text ---- */

Test(text, grows)
{
    nh_text text;
    nh_text_init(&text);
    cr_assert_str_eq(nh_text_string(&text), "");
    nh_text_add(&text, "a");
    nh_text_add_n(&text, "bcd", 2);
    nh_text_addf(&text, "%d%s", 12, "!");
    cr_assert_str_eq(nh_text_string(&text), "abc12!");
    cr_assert_eq(text.length, 6u);
    for (int i = 0; i < 1000; i++)
        nh_text_addf(&text, "%03d", i);
    cr_assert_eq(text.length, 3006u);
    cr_assert_str_eq(nh_text_string(&text) + 3003, "999");
    nh_text_clear(&text);
    cr_assert_str_eq(nh_text_string(&text), "");
    cr_assert_eq(text.capacity, 0u);
}

Test(text, numbers_are_short_and_read_back)
{
    static const struct {
        double value;
        const char *digits;
    } sample[] = {
        {0.1, "0.1"}, {1, "1"}, {-2.5, "-2.5"}, {0, "0"}, {-0.0, "0"}, {1e-10, "1e-10"}, {1e22, "1e+22"},
        {1.0 / 3, "0.3333333333333333"}, {0.1 + 0.2, "0.30000000000000004"}, {2.385, "2.385"},
        {123456789012345, "123456789012345"}, {9007199254740993.0, "9007199254740992"},
        {DBL_MAX, "1.7976931348623157e+308"}, {5e-324, "4.94065645841247e-324"},
        {INFINITY, "inf"}, {-INFINITY, "-inf"}, {NAN, "nan"}, {-NAN, "nan"},
    };
    char out[32];
    for (size_t i = 0; i < sizeof sample / sizeof sample[0]; i++) {
        nh_text_number(sample[i].value, out, sizeof out);
        cr_expect_str_eq(out, sample[i].digits);
    }
}

/* As the first of printf's %.15g, %.16g, %.17g that reads back: of any bits, of decimals with few digits, of usual sizes. */
Test(text, every_number_reads_back_from_as_few_digits_as_printf_needs)
{
    uint64_t state = 88172645463325252u;
    char out[32], expected[32];
    for (int i = 0; i < 100000; i++) {
        double value;
        state ^= state << 13, state ^= state >> 7, state ^= state << 17;
        memcpy(&value, &state, sizeof value);
        if (i % 3 == 1) value = (double)(int64_t)(state >> 40) / 1000;
        if (i % 3 == 2) value = ldexp((double)(state >> 11), -53) * pow(10, (int)(state % 13) - 6);
        if (!isfinite(value))
            continue;
        nh_text_number(value, out, sizeof out);
        for (int digits = 15; digits <= 17; digits++) {
            snprintf(expected, sizeof expected, "%.*g", digits, value);
            if (strtod(expected, NULL) == value) break;
        }
        cr_assert_str_eq(out, expected);
        cr_assert_eq(strtod(out, NULL), value, "%s", out);
    }
}

/* Decimal numbers as people write them, and nothing that would silently become another: no value beyond the range of doubles, no hexadecimal digits. */
Test(text, what_is_read_as_a_number)
{
    static const struct {
        const char *text;
        bool is, fits;
        double value;
    } sample[] = {
        {"0", true, true, 0}, {"-0.0e7", true, true, 0}, {"+2.5", true, true, 2.5}, {".5e1", true, true, 5}, {"7.", true, true, 7}, {"1E-3", true, true, 1e-3},
        {"1e308", true, true, 1e308}, {"5e-324", true, true, 5e-324}, {"0e-999", true, true, 0}, {"1e309", true, false, 0}, {"-1e999", true, false, 0},
        {"1e-999", true, false, 0}, {"-0.001e-400", true, false, 0}, {"", false, false, 0}, {".", false, false, 0}, {"-", false, false, 0}, {"1e", false, false, 0},
        {"1e+", false, false, 0}, {"0x10", false, false, 0}, {"inf", false, false, 0}, {"nan", false, false, 0}, {" 1", false, false, 0}, {"1 ", false, false, 0}, {"1,5", false, false, 0},
    };
    for (size_t i = 0; i < sizeof sample / sizeof *sample; i++) {
        double value = 77;
        cr_expect_eq(nh_text_is_number(sample[i].text), sample[i].is, "`%s`", sample[i].text);
        cr_expect_eq(nh_text_to_number(sample[i].text, &value), sample[i].fits, "`%s`", sample[i].text);
        cr_expect_eq(value, sample[i].fits ? sample[i].value : 77, "`%s`", sample[i].text);
    }
}

Test(text, a_short_buffer_is_not_overrun)
{
    char out[4] = "xxx";
    nh_text_number(1.0 / 3, out, 3);
    cr_assert_str_eq(out, "0.");
    cr_assert_eq(out[3], '\0');
}

static const char *const names[] = {"phi", "psi", "x", "lagrangian", "constraints", "omega", "coordinates", "PSI1"};

static const char *nearest(const char *word)
{
    return nh_text_nearest(word, names, sizeof names / sizeof names[0]);
}

Test(text, finds_what_was_meant)
{
    cr_expect_str_eq(nearest("phii"), "phi");
    cr_expect_str_eq(nearest("pih"), "phi");       /* two letters swapped: one step */
    cr_expect_str_eq(nearest("PHI"), "phi");       /* case */
    cr_expect_str_eq(nearest("psi"), "psi");
    cr_expect_str_eq(nearest("ppi"), "phi");       /* as near as psi: the first wins */
    cr_expect_str_eq(nearest("psii"), "psi");      /* as near as PSI1: the first wins */
    cr_expect_str_eq(nearest("lagragnian"), "lagrangian");
    cr_expect_str_eq(nearest("omga"), "omega");    /* an insertion */
    cr_expect_str_eq(nearest("coord"), "coordinates"); /* a prefix */
    cr_expect_str_eq(nearest("coords"), "coordinates"); /* one letter more */
    cr_expect_str_eq(nearest("xphi"), "phi");
    cr_expect_str_eq(nearest("cunstrants"), "constraints"); /* two steps in ten letters */
    cr_expect_str_eq(nearest("omegadot"), "omega"); /* the other way round */
}

Test(text, does_not_guess_wildly)
{
    cr_expect_null(nearest("energy"));
    cr_expect_null(nearest("hip"));        /* two steps in three letters */
    cr_expect_null(nearest("y"));          /* nothing in common with x */
    cr_expect_null(nearest("co"));         /* too short for a prefix */
    cr_expect_null(nearest("coorxy"));     /* two letters that differ */
    cr_expect_null(nearest("cxxstraxxts")); /* four steps */
    cr_expect_null(nearest(""));
    cr_expect_null(nh_text_nearest("phi", NULL, 0));
    char giant[1000];
    memset(giant, 'x', sizeof giant - 1);
    giant[sizeof giant - 1] = '\0';
    const char *const list[] = {giant};
    cr_expect_null(nearest(giant));
    cr_expect_null(nh_text_nearest("xx", list, 1));
}

Test(text, width_counts_characters)
{
    cr_assert_eq(nh_text_width(""), 0u);
    cr_assert_eq(nh_text_width("abc"), 3u);
    cr_assert_eq(nh_text_width("Čech €"), 6u);
}
