/* current_words: a conserved quantity in the words of mechanics: its sign, its letter, its name, its symmetry. */
#ifndef NH_CURRENT_WORDS_H
#define NH_CURRENT_WORDS_H

#include "base/text.h"
#include "search/analysis.h"

bool nh_current_is_energy(const nh_current *current); /* or minus the energy */
/* `e`, a form of this current, with the sign that readers know: E and p, not -E and -p. */
nh_ex nh_current_signed(const nh_analysis *result, const nh_current *current, nh_ex e);
/* The current with that sign, also that of a moving energy; and without a constant factor where it is no
 * energy, momentum or angular momentum, which such a factor would change. */
nh_ex nh_current_plain(const nh_analysis *result, const nh_current *current);
/* "E = ", "p_x = ", or "": for what stands before the formula; in the arena of the result. */
const char *nh_current_label(const nh_analysis *result, const nh_current *current);

/* "T + V" where the file defines both and the energy is their sum: algebra decides, as T need not be of degree 2
 * in the velocities nor V free of them.  NULL: it is not.  In memory of the analysis. */
const char *nh_current_energy_named(const nh_analysis *r);

/* What is said of a quantity: "Momentum conjugate to x. From shifting x. Proved." */
typedef struct {
    const char *name, *of;  /* "Momentum conjugate to", "x"; or "" */
    const char *doc;        /* the sentence of the system file; or "" */
    const char *how, *what; /* "shifting", "x"; or "" */
    const char *rest;       /* further sentences */
} nh_current_words;

/* Strings belong to the result.  `symmetry`: say from which it comes.  `proof`: how sure it is; NULL: said
 * elsewhere. */
nh_current_words nh_current_words_of(const nh_analysis *result, const nh_current *current, bool symmetry,
                                     const char *proof);
/* Do they differ in the coordinates only, so that one sentence tells both? */
bool nh_current_words_agree(const nh_current_words *a, const nh_current_words *b);
/* The sentences for n that agree. */
void nh_current_words_put(size_t n, const nh_current_words *words, nh_text *out);

/* current_names.c: what a quantity is by Noether's theorem, phi = sign (E Z^0 - p_s Z^s), or sign p_s Z^s, for its
 * symmetry Z: "Jacobi's integral", "Moving energy", "Angular momentum"; "Motion of the centre of mass" with sign 0; ""
 * where it is none. */
typedef struct {
    const char *name;
    int sign;
} nh_current_name;
nh_current_name nh_current_noether(const nh_analysis *result, const nh_current *current);
/* What its form says: "Component of the Laplace-Runge-Lenz vector along", "Quadratic in the velocities", or ""; of:
 * what follows it. */
const char *nh_current_form(const nh_analysis *result, nh_ex phi, const char **of);

/* symmetry_words.c: the symmetry of a quantity, to be read after "from": how = "the symmetry in time", "shifting",
 * "turning", "rotations about", "rotations in the plane of", "boosts along", "a scaling of", "a symmetry that involves
 * the velocities"; what: the coordinates, or nothing.  True: rotations of positions. */
bool nh_symmetry_words(const nh_model *model, const nh_symmetry *symmetry, const char **how, nh_text *what);

#endif
