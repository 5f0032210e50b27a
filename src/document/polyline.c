#include "document/polyline.h"

#include <math.h>

void nh_polyline_write(nh_polyline *p, double x, double y)
{
    nh_text_addf(p->out, "%s%.1f %.1f", p->on ? "L" : "M", x, y);
    p->on = true;
    p->last[0] = x;
    p->last[1] = y;
    p->held = 0;
}

void nh_polyline_end(nh_polyline *p)
{
    if (p->held) nh_polyline_write(p, p->next[0], p->next[1]);
    p->on = false;
}

void nh_polyline_to(nh_polyline *p, double x, double y)
{
    static const double near = 0.25;
    if (!p->on) {
        nh_polyline_write(p, x, y);
        return;
    }
    double dx = x - p->last[0], dy = y - p->last[1], distance = hypot(dx, dy), angle = atan2(dy, dx);
    if (p->held == 0) p->turn = angle, p->low = -M_PI, p->high = M_PI;
    double at = remainder(angle - p->turn, 2 * M_PI), room = distance > near ? asin(near / distance) : M_PI;
    bool back = p->held && distance < hypot(p->next[0] - p->last[0], p->next[1] - p->last[1]);
    if (p->held && (at < p->low || at > p->high || back)) {
        nh_polyline_write(p, p->next[0], p->next[1]);
        nh_polyline_to(p, x, y);
        return;
    }
    p->low = fmax(p->low, at - room);
    p->high = fmin(p->high, at + room);
    p->next[0] = x;
    p->next[1] = y;
    p->held++;
}
