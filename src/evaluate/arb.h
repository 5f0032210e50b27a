/* arb: Arb's numbers, a library of its own up to FLINT 2 and a part of FLINT since version 3. */
#ifndef NH_ARB_H
#define NH_ARB_H

#include <flint/fmpq.h>

#if __has_include(<flint/arb.h>)
#include <flint/arb.h>
#include <flint/arb_fmpz_poly.h>
#include <flint/arb_mat.h>
#include <flint/arb_poly.h>
#include <flint/acb.h>
#include <flint/acb_mat.h>
#include <flint/acb_elliptic.h>
#include <flint/acb_hypgeom.h>
#include <flint/acb_poly.h>
#include <flint/arb_fmpz_poly.h>
#else
#include <arb.h>
#include <arb_fmpz_poly.h>
#include <arb_mat.h>
#include <arb_poly.h>
#include <acb.h>
#include <acb_mat.h>
#include <acb_elliptic.h>
#include <acb_hypgeom.h>
#include <acb_poly.h>
#include <arb_fmpz_poly.h>
#endif

#endif
