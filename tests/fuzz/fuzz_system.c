/* fuzz_system: any bytes as a system file, read as far as the model of its geometry; what is refused must say why and where.
 *
 * Large systems are read but not modelled: elimination takes time that grows with the cube of their size, and is not what is looked for. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/distribution.h"
#include "geometry/model.h"
#include "graph/node.h"

enum { longest = 4000, most_coordinates = 4, most_nodes = 150 };

static void check(bool fine)
{
    if (!fine) abort();
}

static bool is_small(const nh_system *y)
{
    size_t nodes = nh_node_count(y->dag, y->lagrangian);
    for (size_t a = 0; a < y->constraints; a++) nodes += nh_node_count(y->dag, y->constraint[a].lhs) + nh_node_count(y->dag, y->constraint[a].rhs);
    for (size_t s = 0; s < y->coordinates && y->quasi; s++) nodes += nh_node_count(y->dag, y->quasi_map[s]);
    return y->coordinates <= most_coordinates && nodes <= most_nodes;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    nh_error error;
    nh_error_clear(&error);
    if (size > longest) return 0;
    nh_deck *deck = nh_deck_parse("fuzz", (const char *)data, size, &error);
    if (deck) nh_deck_free(deck);
    else check(error.code != NH_OK && error.what[0]);
    if (memchr(data, 0, size)) return 0;
    char *text = malloc(size + 1);
    memcpy(text, data, size);
    text[size] = 0;
    nh_error_clear(&error);
    nh_system *system = nh_system_parse("fuzz", text, 0, NULL, &error);
    check(system || (error.code != NH_OK && error.what[0]));
    if (system && is_small(system)) {
        nh_chart *chart = nh_chart_create(system, NH_CHART_AUTO, 1, &error);
        nh_model *model = chart ? nh_model_create(system, chart, &error) : NULL;
        check(model || (error.code != NH_OK && error.what[0]));
        if (model) nh_distribution_of(model);
        nh_model_free(model);
    }
    nh_system_free(system);
    free(text);
    return 0;
}
