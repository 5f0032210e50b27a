/* motion_sheet: the motion as formulas (search/explicit_motion.h) as a sheet. */
#ifndef NH_MOTION_SHEET_H
#define NH_MOTION_SHEET_H

#include "document/sheet.h"

/* NULL where no such motion is known. */
nh_sheet *nh_motion_sheet(const nh_analysis *result);
/* The member `explicit_motion` of a result: null where none is known. */
void nh_motion_sheet_json(const nh_analysis *result, nh_json *to);

#endif
