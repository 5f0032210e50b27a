/* page: the files of src/document/page, which the build embeds (page/embed.sh). */
#ifndef NH_PAGE_H
#define NH_PAGE_H

extern const char nh_page_style[];   /* page.css */
extern const char nh_page_solver[];  /* solver.js: the integrator */
extern const char nh_page_special[]; /* special.js: functions that JavaScript lacks */
extern const char nh_page_scene[];   /* scene.js: the moving picture */
extern const char nh_page_script[];  /* page.js: controls, plots, table */
extern const char nh_page_font[];    /* font.woff2, in base 64 */

#endif
