/* urdf_root: the robot as a whole: is it one, and what does everything hang on?  See urdf_internal.h. */
#include <string.h>

#include "base/text.h"
#include "system/urdf_internal.h"

bool nh_urdf_is_robot(nh_urdf_reader *u, const nh_xml *robot)
{
    static const struct {
        const char *name, *what;
    } others[] = {{"sdf", "SDF, Gazebo's format"}, {"mujoco", "MJCF, MuJoCo's format"}, {"COLLADA", "a mesh"}};
    if (!strcmp(robot->name, "robot")) return true;
    nh_urdf_fail(u, robot->begin, "a robot description begins with <robot>, not with <%s>", robot->name);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (!strcmp(robot->name, others[i].name))
            return nh_error_hint(u->error, "this is %s; only URDF is read", others[i].what);
    return nh_error_hint(
        u->error,
        "files in XML are robot descriptions (URDF), other systems are YAML: `nhsym new skate` writes an example");
}

bool nh_urdf_fits(nh_urdf_reader *u, const nh_xml *robot, size_t links, size_t joints)
{
    enum { most = 1000 };
    if (links > most || joints > most)
        return nh_urdf_fail(u, robot->begin, "this robot has more than %d links or joints", most);
    if (links) return true;
    nh_urdf_fail(u, robot->begin, "this robot has no <link>");
    return nh_xml_get(robot, "xmlns:xacro")
               ? nh_error_hint(u->error, "if its links are made by xacro: xacro robot.urdf.xacro > robot.urdf")
               : false;
}

const char *nh_urdf_end(const nh_xml *element, const char *key)
{
    const nh_xml_attribute *a = nh_xml_get(nh_xml_child(element, key, NULL), "link");
    return a ? a->value : "";
}

static bool is_among(const char *name, size_t count, const char *const *names)
{
    for (size_t i = 0; i < count; i++)
        if (!strcmp(name, names[i])) return true;
    return false;
}

const char *nh_urdf_implicit_root(const nh_xml *robot, size_t links, const char *const *written)
{
    const char *found = NULL;
    const nh_xml *first = nh_xml_child(robot, "joint", NULL);
    for (const nh_xml *e = first; e; e = nh_xml_child(robot, "joint", e)) {
        const char *name = nh_urdf_end(e, "parent");
        if (!*name || is_among(name, links, written)) continue;
        if (found && strcmp(found, name)) return NULL;
        found = name;
    }
    for (const nh_xml *e = first; found && e; e = nh_xml_child(robot, "joint", e))
        if (!strcmp(nh_urdf_end(e, "child"), found)) return NULL;
    for (size_t i = 0; found && i < links; i++) {
        const nh_xml *e = first;
        while (e && strcmp(nh_urdf_end(e, "child"), written[i])) e = nh_xml_child(robot, "joint", e);
        if (!e) return NULL;
    }
    return found && strcmp(found, "world") && nh_text_nearest(found, written, links) ? NULL : found;
}

bool nh_urdf_distinct_joints(nh_urdf_reader *u, const nh_xml *robot)
{
    for (const nh_xml *e = nh_xml_child(robot, "joint", NULL); e; e = nh_xml_child(robot, "joint", e)) {
        const nh_xml_attribute *name = nh_xml_get(e, "name");
        for (const nh_xml *k = nh_xml_child(robot, "joint", NULL); k != e; k = nh_xml_child(robot, "joint", k))
            if (!strcmp(name->value, nh_xml_get(k, "name")->value))
                return nh_urdf_fail(u, name->begin, "there are two joints `%s`", name->value);
    }
    return true;
}
