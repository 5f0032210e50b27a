/* absence_words: what is known of other integrals (absence/absence.h), as sentences.
 *
 * Formulas within a sentence stand between NH_ABSENCE_WORDS_FORMULA and NH_ABSENCE_WORDS_END, so that a page can set
 * them; nh_absence_words_plain takes the marks away. */
#ifndef NH_ABSENCE_WORDS_H
#define NH_ABSENCE_WORDS_H

#include "base/text.h"
#include "search/analysis.h"

#define NH_ABSENCE_WORDS_FORMULA "\002"
#define NH_ABSENCE_WORDS_END "\003"

/* In the order in which they are read; the first is the statement itself. */
typedef struct {
    size_t count;
    const char **sentence;
    const char *not_excluded; /* the one of these that says what is not; or NULL */
} nh_absence_words;

/* All that the analysis says: the statement, what is excluded besides, what is not, states of rest; in the arena of the
 * result.  None where the question was not asked. */
nh_absence_words nh_absence_words_of(const nh_analysis *result);
/* The same as one text without marks: of JSON; in the arena.  NULL where there are none. */
const char *nh_absence_words_sentence(const nh_analysis *result);
/* The statement for a first screen, without marks: at most `lines` lines of 80 columns, if names are not very long; in
 * the arena.  NULL where nothing is excluded, and it was not asked for by --absence. */
const char *nh_absence_words_short(const nh_analysis *result, size_t lines);
const char *nh_absence_words_plain(nh_arena *arena, const char *marked);

/* " and by a theorem (below)" where every other integral that is meromorphic near some motions is excluded, else "":
 * behind "as far as was looked". */
const char *nh_absence_words_headline(const nh_analysis *analysis);

#endif
