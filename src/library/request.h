/* request: the words of the command line, and of a question of nhsym.h, as a request (commands/request.h). */
#ifndef NH_LIBRARY_REQUEST_H
#define NH_LIBRARY_REQUEST_H

#include "base/text.h"
#include "commands/request.h"

/* A numerical option by its name (base/option.h); "auto", "quasi" or "coordinates"; the name of one more integrator, or
   "auto". */
bool nh_request_option(nh_request *request, const char *name, const char *text, nh_error *error);
/* A number, or an expression of numbers: 2*pi, 90deg, 1/3. */
bool nh_request_number(const char *text, double *value);
bool nh_request_velocities(nh_request *request, const char *word, nh_error *error);
/* The same of --route. */
bool nh_request_route(nh_request *q, const char *word, nh_error *error);
bool nh_request_grid(nh_request *request, const char *word, nh_error *error);
bool nh_request_method(nh_request *request, const char *word, nh_error *error);
/* The entries of a list of integrators. */
bool nh_request_methods(nh_request *request, const char *list, nh_error *error);
/* Remembers "--option NAME=TEXT" for a command line that names the system. */
void nh_request_typed(nh_request *request, const char *option, const char *name, const char *text);
/* One more setting of the system. */
void nh_request_setting(nh_request *request, nh_setting setting);
/* A parameter over time: an expression of t, or FILE.csv:COLUMN. */
bool nh_request_input(nh_request *request, const char *name, const char *text, nh_error *error);

/* The file of a system by name or path, with the additions. */
bool nh_request_system(nh_request *request, const char *word, nh_error *error);
/* Writes the notes about the system file: lines that begin with `head`. */
void nh_request_remarks(const nh_request *request, const char *head, nh_text *out);
/* An error in an addition is an error of the command line: the message shows the option and its value. */
void nh_request_blame(const nh_request *request, nh_error *error);

/* The file of an analysis by name or path; the one that has the name of the system, if there is one: a system by path
   has none, nor one with additional levels. */
bool nh_request_analysis(nh_request *request, const char *word, nh_error *error);
void nh_request_usual_analysis(nh_request *request, const char *system);
/* The system that the analysis asks about; NULL: it names none, or there is an error. */
const char *nh_request_subject(const nh_request *request, nh_error *error);

#endif
