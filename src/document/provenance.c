#include "document/provenance.h"

#include "base/versions.h"

void nh_run_json(const nh_run *r, const nh_system *system, nh_json *to)
{
    if (!nh_json_get(to, "title")) nh_json_put_text(to, "title", system->title);
    nh_json *parameters = nh_json_get(to, "parameters") ? NULL : nh_json_put_object(to, "parameters");
    for (size_t i = 0; parameters && i < system->parameters; i++)
        nh_json_put_number(parameters, system->parameter[i].name, system->parameter[i].value);
    nh_json *run = nh_json_put_object(to, "run");
    nh_json_put_text(run, "command", r->command);
    nh_json_put_text(run, "system_file", r->system_path);
    nh_json_put_text(run, "analysis_file", r->analysis_path);
    nh_json_put_number(run, "seed", r->seed);
    nh_json_put_text(run, "machine", nh_versions_machine());
    nh_json *libraries = nh_json_put_object(run, "libraries");
    for (size_t i = 0; nh_version_of(i).name; i++)
        nh_json_put_text(libraries, nh_version_of(i).name, nh_version_of(i).version);
}
