/* analysis_internal: what the files analysis_*.c share. */
#ifndef NH_DOCUMENT_ANALYSIS_INTERNAL_H
#define NH_DOCUMENT_ANALYSIS_INTERNAL_H

#include "base/json.h"
#include "document/analysis.h"
#include "document/sheet.h"

/* ---- sections of the document ---- */

void nh_analysis_write_meaning(nh_pen *pen, const nh_analysis *result,
                               const char *meaning); /* "momentum of phi", with the letter */
void nh_analysis_write_currents(nh_pen *pen, const nh_analysis *result);
void nh_analysis_write_series(nh_pen *pen, const nh_analysis *result, const nh_current *current);
void nh_analysis_write_motion(nh_pen *pen, const nh_analysis *result);
void nh_analysis_write_figures(nh_pen *pen, const nh_analysis *result);
void nh_analysis_write_search(nh_pen *pen, const nh_analysis *result);
/* Is there a section on other integrals?  Where it was asked, and the answer says something. */
bool nh_analysis_has_absence(const nh_analysis *result);
void nh_analysis_write_absence(nh_pen *pen, const nh_analysis *result);
/* Its statement as a paragraph; nothing where nothing is excluded. */
void nh_analysis_write_absence_statement(nh_pen *pen, const nh_analysis *result);

/* ---- parts of the JSON ---- */

/* the motion, and the largest changes of the currents along it */
void nh_analysis_json_validation(const nh_analysis *result, nh_json *to);
void nh_analysis_json_stated(const nh_analysis *result, nh_json *to);  /* what the system file says of currents */
void nh_analysis_json_figures(const nh_analysis *result, nh_json *to); /* those of the analysis file */
void nh_analysis_json_absence(const nh_analysis *result, nh_json *to); /* is there any other integral? */
/* How many numbers along the motion are not finite. */
size_t nh_analysis_json_holes(const nh_analysis *result);
void nh_analysis_json_samples(const nh_analysis *result, nh_json *to);      /* the sample points */
void nh_analysis_json_completeness(const nh_analysis *result, nh_json *to); /* how many integrals there are */
void nh_analysis_json_stages(const nh_analysis *result, nh_json *to);       /* which stages were tried */

/* ---- the motion as formulas (search/explicit_motion.h) ---- */

/* NULL where no such motion is known. */
nh_sheet *nh_motion_sheet(const nh_analysis *result);
/* The member `explicit_motion` of a result: null where none is known. */
void nh_motion_sheet_json(const nh_analysis *result, nh_json *to);

#endif
