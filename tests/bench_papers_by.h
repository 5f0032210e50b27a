/* bench_papers_by: computations of single rows: both sides of an equation, by what the program prints. */
#ifndef NH_TESTS_BENCH_PAPERS_BY_H
#define NH_TESTS_BENCH_PAPERS_BY_H

/* ---- small parts ---- */

static nh_ex coefficient(const document *d, const char *section, const char *label, const char *of) { return parsed(d, shown(d, section, label, of)); }

static double differ(const document *d, nh_ex got, nh_ex want)
{
    double a[points], b[points];
    evaluate(d, got, a);
    evaluate(d, want, b);
    return apart(a, b);
}

/* sum of products of pairs */
static nh_ex dot(const document *d, size_t n, const nh_ex *a, const nh_ex *b)
{
    nh_ex sum = nh_int(d->system->dag, 0);
    for (size_t i = 0; i < n; i++) sum = nh_add(d->system->dag, sum, nh_mul(d->system->dag, a[i], b[i]));
    return sum;
}

/* e on the constraint submanifold: the velocity of `name` replaced by its normal form. */
static nh_ex inserted(const document *d, nh_ex e, const char *velocity)
{
    nh_ex v = parsed(d, velocity), g = coefficient(d, "normal_form", velocity, "");
    return nh_substitute(d->system->dag, e, 1, &v, &g);
}

/* Gamma(e), Gamma as printed. */
static nh_ex rate(const document *d, nh_ex e)
{
    nh_dag *g = d->system->dag;
    nh_ex sum = nh_int(g, 0);
    for (size_t i = 0; i < d->symbols; i++) {
        char of[80];
        snprintf(of, sizeof of, "d/d%s", nh_name_of(g, d->symbol[i]));
        sum = nh_add(g, sum, nh_mul(g, coefficient(d, "semispray", "Gamma", of), nh_diff(g, e, d->symbol[i])));
    }
    return sum;
}

/* ---- the sleigh ---- */

static const char *const FREE[2] = {"phi", "x"};

static double euler(const document *d)
{
    static const char *const factor[3] = {"", "phi''", "x''"};
    double worst = 0;
    nh_dag *g = d->system->dag;
    for (size_t l = 0; l < 2; l++)
        for (size_t r = 0; r < 3; r++) {
            char first[40], second[40], A[20], B[20];
            snprintf(first, sizeof first, "eps_%s(Lbar)", FREE[l]);
            snprintf(second, sizeof second, "eps_%s(g^y)", FREE[l]);
            snprintf(A, sizeof A, "Abar_%s", FREE[l]);
            snprintf(B, sizeof B, "Bbar_%s,%s", FREE[l], r ? FREE[r - 1] : "");
            nh_ex left = nh_sub(g, coefficient(d, "euler_expressions", first, factor[r]),
                                nh_mul(g, coefficient(d, "lagrangian", "Lbar_y", ""), coefficient(d, "euler_expressions", second, factor[r])));
            worst = fmax(worst, differ(d, left, coefficient(d, "reduced_equations", r ? B : A, "")));
        }
    return worst;
}

/* Abar_s = A_s + A_y g_s + (B_sy + B_yy g_s) d'_c g/dt, all on the submanifold. */
static double projection(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex normal = coefficient(d, "normal_form", "y'", ""), turn = along(d, "d'_c/dt", normal);
    double worst = 0;
    for (size_t l = 0; l < 2; l++) {
        char line[4] = {'#', (char)('0' + l), 0}, label[20], velocity[20];
        snprintf(label, sizeof label, "Abar_%s", FREE[l]);
        snprintf(velocity, sizeof velocity, "%s'", FREE[l]);
        nh_ex slope = nh_diff(g, normal, parsed(d, velocity)), inner = nh_add(g, coefficient(d, "chetaev_equations", line, "y''"), nh_mul(g, coefficient(d, "chetaev_equations", "#2", "y''"), slope));
        nh_ex e = nh_add(g, coefficient(d, "chetaev_equations", line, ""), nh_mul(g, coefficient(d, "chetaev_equations", "#2", ""), slope));
        e = nh_add(g, e, nh_mul(g, inner, turn));
        worst = fmax(worst, differ(d, inserted(d, e, "y'"), coefficient(d, "reduced_equations", label, "")));
    }
    return worst;
}

static double chetaev(const document *d)
{
    static const char *const names[3] = {"phi", "x", "y"};
    nh_dag *g = d->system->dag;
    double worst = 0;
    for (size_t i = 0; i < 3; i++) {
        char line[4] = {'#', (char)('0' + i), 0};
        nh_ex left = coefficient(d, "chetaev_equations", line, ""), right = nh_mul(g, coefficient(d, "chetaev_equations", line, "=mu"), coefficient(d, "chetaev_equations", "mu", "")), size;
        for (size_t r = 0; r < 3; r++) {
            char of[20], velocity[20];
            snprintf(of, sizeof of, "%s''", names[r]);
            snprintf(velocity, sizeof velocity, "%s'", names[r]);
            left = nh_add(g, left, nh_mul(g, coefficient(d, "chetaev_equations", line, of), rate(d, r == 2 ? coefficient(d, "normal_form", "y'", "") : parsed(d, velocity))));
        }
        size = parsed(d, "m*phi'*x'");
        worst = fmax(worst, differ(d, nh_add(g, inserted(d, left, "y'"), size), nh_add(g, right, size)));
    }
    return worst;
}

static double chetaev_field(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex normal = coefficient(d, "normal_form", "y'", ""), e = nh_mul(g, normal, unknown(d, "Z^0"));
    e = nh_add(g, e, nh_mul(g, nh_diff(g, normal, parsed(d, "x'")), unknown(d, "zeta^x")));
    return differ(d, component(d, "y"), e);
}

/* F_1 = Z(Lbar_y) + (Lbar - pbar v) dZ^0/dy + pbar_l dZ^l/dy; g does not depend on y. */
static double lie_form(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex sum = nh_int(g, 0), y = parsed(d, "y"), La = coefficient(d, "lagrangian", "Lbar_y", ""), inner = coefficient(d, "lagrangian", "Lbar", "");
    for (size_t i = 0; i < d->symbols; i++) {
        const char *name = nh_name_of(g, d->symbol[i]);
        if (at(at(d->root, "symmetry.components"), name)) sum = nh_add(g, sum, nh_mul(g, component(d, name), nh_diff(g, La, d->symbol[i])));
    }
    for (size_t l = 0; l < 2; l++) {
        char velocity[20], label[40];
        snprintf(velocity, sizeof velocity, "%s'", FREE[l]);
        snprintf(label, sizeof label, "dLbar/d%s", velocity);
        nh_ex p = coefficient(d, "lagrangian", label, "");
        inner = nh_sub(g, inner, nh_mul(g, p, parsed(d, velocity)));
        sum = nh_add(g, sum, nh_mul(g, p, nh_diff(g, component(d, FREE[l]), y)));
    }
    sum = nh_add(g, sum, nh_mul(g, inner, nh_diff(g, component(d, "t"), y)));
    return differ(d, coefficient(d, "currents", "F_1(Phi)", ""), sum);
}

static double current_of_field(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex sum = nh_mul(g, coefficient(d, "lagrangian", "Lbar", ""), unknown(d, "Z^0"));
    for (size_t l = 0; l < 2; l++) {
        char label[20], name[20];
        snprintf(label, sizeof label, "dLbar/d%s'", FREE[l]);
        snprintf(name, sizeof name, "zeta^%s", FREE[l]);
        sum = nh_add(g, sum, nh_mul(g, coefficient(d, "lagrangian", label, ""), unknown(d, name)));
    }
    return differ(d, sum, parsed(d, text_at(d->root, "current")));
}

/* (15) as printed has X_l(g_s - X_s(g_l)) for X_l(g_s) - X_s(g_l) in the bracket of Z^0. */
static double equation_15(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex normal = coefficient(d, "normal_form", "y'", ""), slope[2], more[2], factor = nh_mul(g, unknown(d, "Z^0"), coefficient(d, "lagrangian", "Lbar_y", ""));
    static const char *const label[2] = {"d_c/dphi", "d_c/dx"}, *const velocity[2] = {"phi'", "x'"};
    for (size_t s = 0; s < 2; s++) slope[s] = nh_diff(g, normal, parsed(d, velocity[s]));
    for (size_t l = 0; l < 2; l++) {
        more[l] = nh_int(g, 0);
        for (size_t s = 0; s < 2; s++) {
            nh_ex turn = along(d, label[s], slope[l]);
            more[l] = nh_add(g, more[l], nh_mul(g, parsed(d, velocity[s]), nh_sub(g, along(d, label[l], turn), turn)));
        }
        more[l] = nh_mul(g, factor, more[l]);
    }
    return violation(d, "15", more);
}

/* The determining equations as they are printed for a constraint with eps'_l(g) = 0: the largest left side beside its terms. */
static double semiholonomic(const document *d)
{
    enum { terms = 8 };
    nh_dag *g = d->system->dag;
    nh_ex Lbar = coefficient(d, "lagrangian", "Lbar", ""), time = component(d, "t"), energy = nh_neg(g, Lbar), v[2], p[2], Z[2], slide[2];
    double worst = 0;
    for (size_t l = 0; l < 2; l++) {
        char name[40];
        snprintf(name, sizeof name, "%s'", FREE[l]);
        v[l] = parsed(d, name);
        p[l] = nh_diff(g, Lbar, v[l]);
        Z[l] = component(d, FREE[l]);
        slide[l] = nh_sub(g, Z[l], nh_mul(g, v[l], time));
        energy = nh_add(g, energy, nh_mul(g, p[l], v[l]));
    }
    for (size_t k = 0; k < 5; k++) { /* one; two for l; two for l */
        nh_ex term[terms];
        size_t n = 0, l = (k + 1) % 2;
        char by[40];
        snprintf(by, sizeof by, k ? "d_c/d%s" : "d'_c/dt", FREE[l]);
        if (k < 3) {
            term[n++] = nh_mul(g, along(d, "d'_c/dt", k ? p[l] : Lbar), time);
            term[n++] = nh_neg(g, nh_mul(g, energy, along(d, by, time)));
        } else {
            term[n++] = nh_neg(g, nh_mul(g, energy, nh_diff(g, time, v[l])));
        }
        for (size_t s = 0; s < 2; s++) {
            char over[40], velocity[40];
            snprintf(over, sizeof over, "d_c/d%s", FREE[s]);
            snprintf(velocity, sizeof velocity, "%s'", FREE[s]);
            if (k < 3) term[n++] = nh_mul(g, along(d, over, k ? p[l] : Lbar), slide[s]);
            if (k == 1 || k == 2) term[n++] = nh_mul(g, component(d, velocity), nh_diff(g, p[l], v[s]));
            term[n++] = nh_mul(g, p[s], k < 3 ? along(d, by, Z[s]) : nh_diff(g, Z[s], v[l]));
        }
        double sum[points] = {0}, size[points] = {0}, value[points];
        for (size_t i = 0; i < n; i++) {
            evaluate(d, term[i], value);
            for (size_t q = 0; q < points; q++) sum[q] += value[q], size[q] += fabs(value[q]);
        }
        for (size_t q = 0; q < points; q++) worst = fmax(worst, fabs(sum[q]) / size[q]);
    }
    return worst;
}

static void equation_24(const document *d, double *printed, double *meant)
{
    nh_dag *g = d->system->dag;
    nh_ex time = nh_add(g, coefficient(d, "currents", "[Gamma,Z(Phi)]", "d/dt"), coefficient(d, "currents", "[Gamma,Z(Phi)]", "Gamma")), turned = rate(d, component(d, "t"));
    *printed = differ(d, time, nh_neg(g, turned));
    *meant = differ(d, time, turned);
}

static void equation_32(const document *d, double *printed, double *meant)
{
    nh_dag *g = d->system->dag;
    nh_ex rest = parsed(d, "m*sin(phi)*phi'*x'/cos(phi)^3"), mass = parsed(d, "-m/cos(phi)^2"), force = parsed(d, "m*a*phi'^2/cos(phi)");
    *printed = differ(d, nh_mul(g, mass, rate(d, parsed(d, "phi'"))), rest);
    *meant = differ(d, nh_mul(g, mass, rate(d, parsed(d, "x'"))), nh_sub(g, rest, force));
}

static double equation_34(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex e = coefficient(d, "determining_equations", "(18, phi)", "Z^0");
    e = nh_sub(g, e, nh_mul(g, parsed(d, "x'"), coefficient(d, "determining_equations", "(18, phi)", "zeta^x")));
    e = nh_sub(g, e, nh_mul(g, parsed(d, "phi'"), coefficient(d, "determining_equations", "(18, phi)", "zeta^phi")));
    return differ(d, e, parsed(d, "m*x'^2*tan(phi)/cos(phi)^2"));
}

static double parameter_of(const document *d, const char *name)
{
    for (size_t i = 0; i < d->system->parameters; i++)
        if (!strcmp(d->system->parameter[i].name, name)) return d->system->parameter[i].value;
    return NAN;
}

static void set(document *d, size_t p, const char *name, double value)
{
    nh_ex e = parsed(d, name);
    for (size_t i = 0; i < d->symbols; i++)
        if (d->symbol[i] == e) d->value[p][i] = value;
}

/* Along (33): phi = k asin tanh tau, v = x'/cos phi = a k omega_0 tanh tau, tau = omega_0 t/k; where = 33: in Gamma; 37, 38: the energies. */
static double motion(const document *from, int where)
{
    static document d;
    double m = parameter_of(from, "m"), a = parameter_of(from, "a"), k = parameter_of(from, "k"), w0 = 1.3, got[2][points], want[2][points];
    double E0 = m * a * a * k * k * w0 * w0 / 2;
    d = *from;
    for (size_t p = 0; p < points; p++) {
        double tau = 0.05 + 0.06 * (double)p, ch = cosh(tau), phi = k * asin(tanh(tau)), w = w0 / ch, v = a * k * w0 * tanh(tau);
        set(&d, p, "phi", phi);
        set(&d, p, "phi'", w);
        set(&d, p, "x'", v * cos(phi));
        want[0][p] = where == 33 ? -w0 * w0 / k * sinh(tau) / (ch * ch) : where == 37 ? E0 * tanh(tau) * tanh(tau) : E0 * (tanh(tau) * tanh(tau) + 1 / (k * k * ch * ch));
        want[1][p] = where == 33 ? a * w0 * w0 * cos(phi) / (ch * ch) - v * sin(phi) * w : where == 37 ? E0 / (ch * ch) : E0 / (ch * ch) * (1 - 1 / (k * k));
    }
    if (where == 33) evaluate(&d, coefficient(&d, "semispray", "Gamma", "d/dphi'"), got[0]), evaluate(&d, coefficient(&d, "semispray", "Gamma", "d/dx'"), got[1]);
    if (where == 37) values(&d, E_T, got[0]), values(&d, "m/2*a^2*k^2*phi'^2", got[1]);
    if (where == 38) values(&d, "m/2*((x' - a*phi'*sin(phi))^2 + (x'*tan(phi) + a*phi'*cos(phi))^2)", got[0]), values(&d, "m/2*a^2*(k^2 - 1)*phi'^2", got[1]);
    return fmax(apart(got[0], want[0]), apart(got[1], want[1]));
}

/* ---- the nonlinear constraint: y and z are free, x' a root ---- */

static void equation_22(const document *d, double *printed, double *meant)
{
    static const char *const q[2] = {"y", "z"}, *const X[2] = {"d_c/dy", "d_c/dz"};
    nh_dag *g = d->system->dag;
    nh_ex inverse[4], bend[4], G[4], turn[2], A[2], slope[2], zeta[2], w[2], Phi = parsed(d, text_at(d->root, "current")), sum = nh_int(g, 0), right = sum;
    Phi = inserted(d, Phi, "x'");
    for (size_t l = 0; l < 2; l++) {
        char label[40], of[20];
        snprintf(of, sizeof of, "%s'", q[l]);
        w[l] = parsed(d, of);
        slope[l] = nh_diff(g, Phi, w[l]);
        snprintf(label, sizeof label, "Abar_%s", q[l]);
        A[l] = coefficient(d, "reduced_equations", label, "");
        snprintf(label, sizeof label, "eps_%s(g^x)", q[l]);
        turn[l] = coefficient(d, "euler_expressions", label, "");
        for (size_t s = 0; s < 2; s++) {
            snprintf(of, sizeof of, "%s''", q[s]);
            bend[2 * l + s] = nh_neg(g, coefficient(d, "euler_expressions", label, of));
            char name[40];
            snprintf(name, sizeof name, "(Bbar^-1)_%s,%s", q[l < s ? l : s], q[l < s ? s : l]);
            inverse[2 * l + s] = coefficient(d, "reduced_equations", name, "");
            G[2 * l + s] = nh_int(g, 0);
        }
    }
    G[1] = coefficient(d, "reduced_equations", "G_y,z", "");
    G[2] = nh_neg(g, G[1]);
    for (size_t l = 0; l < 2; l++) zeta[l] = nh_neg(g, dot(d, 2, inverse + 2 * l, slope));
    for (size_t l = 0; l < 2; l++)
        for (size_t s = 0; s < 2; s++) {
            nh_ex inner = nh_mul(g, turn[l], slope[s]), lift = along(d, X[s], Phi);
            for (size_t r = 0; r < 2; r++) lift = nh_add(g, lift, nh_mul(g, zeta[r], G[2 * r + s])); /* - dPhi/dq'^v B^rv = zeta^r */
            for (size_t p = 0; p < 2; p++) inner = nh_add(g, inner, nh_mul(g, nh_mul(g, w[p], bend[2 * p + l]), lift));
            sum = nh_add(g, sum, nh_mul(g, inverse[2 * l + s], inner));
        }
    for (size_t l = 0; l < 2; l++) {
        nh_ex inner = turn[l];
        for (size_t r = 0; r < 2; r++) inner = nh_add(g, inner, nh_mul(g, bend[2 * l + r], dot(d, 2, inverse + 2 * r, A)));
        right = nh_sub(g, right, nh_mul(g, zeta[l], inner));
    }
    nh_ex form = inserted(d, coefficient(d, "currents", "i_[Gamma,Z(Phi)]phi^1", ""), "x'");
    *printed = differ(d, inserted(d, sum, "x'"), form);
    *meant = differ(d, inserted(d, right, "x'"), form);
}

/* ---- the crane ---- */

static double crane_hamiltonian(const document *d)
{
    static const char *const q[4] = {"psi1", "phi1", "psi2", "phi2"};
    nh_dag *g = d->system->dag;
    nh_ex p[4], v[4], twice, H = nh_int(g, 0);
    char label[60];
    for (size_t i = 0; i < 4; i++) {
        p[i] = nh_int(g, 0);
        for (size_t j = 0; j < 4; j++) {
            snprintf(label, sizeof label, "%s'", q[j]);
            v[j] = parsed(d, label);
            snprintf(label, sizeof label, "Khat_%s,%s", q[i < j ? i : j], q[i < j ? j : i]);
            p[i] = nh_add(g, p[i], nh_mul(g, coefficient(d, "0.hamiltonian", label, ""), v[j]));
        }
    }
    twice = dot(d, 4, p, v);
    for (size_t i = 0; i < 4; i++)
        for (size_t j = i; j < 4; j++) {
            snprintf(label, sizeof label, i == j ? "p_%s^2" : "p_%s p_%s", q[i], q[j]);
            H = nh_add(g, H, nh_mul(g, coefficient(d, "0.hamiltonian", "Hhat", label), nh_mul(g, p[i], p[j])));
        }
    return differ(d, nh_mul(g, nh_int(g, 2), H), twice);
}

static double upsilon(const document *d)
{
    static const char *const q[4] = {"psi1'", "phi1'", "psi2'", "phi2'"};
    static const char *const vector[4] = {"-b*(c - l*sin(psi1))", "0", "-2*c*cos(psi1)", "-b*cos(psi1)"}; /* of x, y, psi3, theta */
    nh_dag *g = d->system->dag;
    nh_ex left = nh_int(g, 0), right = left;
    for (size_t k = 0; k < 4; k++) {
        left = nh_add(g, left, nh_mul(g, coefficient(d, "0.gyroscopic_form", "Upsilon_psi1,psi2", q[k]), parsed(d, q[k])));
        for (size_t a = 0; a < 4; a++) {
            char label[10];
            snprintf(label, sizeof label, "J_%zu", a + 1);
            nh_ex J = nh_mul(g, coefficient(d, "0.gyroscopic_form", label, q[k]), parsed(d, q[k]));
            right = nh_add(g, right, nh_mul(g, J, nh_mul(g, parsed(d, vector[a]), parsed(d, "l/" DELTA "^2"))));
        }
    }
    return differ(d, left, right);
}

static cJSON *reference(const char *name)
{
    char path[120];
    snprintf(path, sizeof path, "tests/data/%s", name);
    FILE *file = fopen(path, "rb");
    if (!file) stop("cannot read", path);
    fseek(file, 0, SEEK_END);
    size_t length = (size_t)ftell(file);
    rewind(file);
    char *text = calloc(length + 1, 1);
    if (!text || fread(text, 1, length, file) != length) stop("cannot read", path);
    fclose(file);
    cJSON *root = cJSON_Parse(text);
    free(text);
    return root;
}

/* Numbers, or lists of them, or texts: flat. */
static size_t flat(const cJSON *item, double *out)
{
    size_t n = 0;
    if (!cJSON_IsArray(item)) return *out = cJSON_IsNumber(item) ? item->valuedouble : strtod(item->valuestring, NULL), 1;
    for (const cJSON *each = item->child; each; each = each->next) n += flat(each, out + n);
    return n;
}

/* The metric of the shipped crane against independent values with their parameters, at their places. */
static double crane_metric(void)
{
    cJSON *data = reference("crane_oracle.json");
    const cJSON *one = cJSON_GetArrayItem(at(data, "sets"), 0), *parameter;
    char words[4000] = "verify crane --equations --current t";
    nh_setting setting[24];
    size_t n = 0;
    cJSON_ArrayForEach(parameter, at(one, "params")) {
        snprintf(words + strlen(words), sizeof words - strlen(words), " --set %s=%.17g", parameter->string, parameter->valuedouble);
        setting[n++] = (nh_setting){.name = parameter->string, .value = parameter->valuedouble};
    }
    static document d;
    d = (document){.root = run(words), .system = system_of("crane", n, setting)};
    scatter(&d);
    double worst = 0, q[8], K[64], got[points];
    for (size_t i = 0; i < 8; i++)
        for (size_t j = 0; j < 8; j++) {
            char line[4] = {'#', (char)('0' + i), 0}, of[40];
            snprintf(of, sizeof of, "%s''", cJSON_GetArrayItem(at(data, "joint_coordinates"), (int)j)->valuestring);
            const char *name = cJSON_GetArrayItem(at(data, "joint_coordinates"), (int)i)->valuestring;
            for (size_t k = 0; k < 8; k++)
                if (!strcmp(d.system->coordinate[k].name, name)) line[1] = (char)('0' + k);
            for (size_t p = 0; p < points; p++) {
                flat(at(cJSON_GetArrayItem(at(one, "points"), (int)p), "q_full"), q);
                for (size_t k = 0; k < 8; k++) set(&d, p, cJSON_GetArrayItem(at(data, "joint_coordinates"), (int)k)->valuestring, q[k]);
            }
            evaluate(&d, coefficient(&d, "chetaev_equations", line, of), got);
            for (size_t p = 0; p < points; p++) {
                flat(at(cJSON_GetArrayItem(at(one, "points"), (int)p), "K_full"), K);
                worst = fmax(worst, fabs(got[p] + K[i * 8 + j]) / (1 + fabs(K[i * 8 + j])));
            }
        }
    cJSON_Delete(d.root);
    nh_system_free(d.system);
    cJSON_Delete(data);
    return worst;
}

/* ---- stages ---- */

/* Brackets, or Euler-Poincare right-hand sides, by stages, against direct ones: the largest difference; and from what (20) gives. */
static void stages(bool bracket, size_t most_blocks, double *error, double *off)
{
    cJSON *data = reference("stages_oracle.json");
    const cJSON *each;
    *error = *off = 0;
    cJSON_ArrayForEach(each, at(data, "cases")) {
        double c[1000], g0[100], eta[10], other[10], beta[10], want[10], printed[10], got[10], index[10];
        size_t size[10], order[10], blocks = 0, d = 0;
        const cJSON *b;
        cJSON_ArrayForEach(b, at(each, "blocks")) {
            size[blocks] = flat(b, index);
            for (size_t i = 0; i < size[blocks]; i++) order[d++] = (size_t)index[i];
            blocks++;
        }
        if (blocks > most_blocks) continue;
        nh_algebra g = nh_algebra_create(d);
        flat(at(each, "structure_constants"), c);
        memcpy(g.c, c, d * d * d * sizeof *c);
        flat(at(each, "metric"), g0);
        flat(at(each, "eta"), eta);
        flat(at(each, "etabar"), other);
        flat(at(each, "beta"), beta);
        flat(at(each, bracket ? "bracket" : "betadot"), want);
        flat(at(each, "betadot_printed_eq20"), printed);
        nh_error e = {0};
        nh_ideals chain;
        if (!nh_ideals_init(&chain, &g, blocks, size, order, g0, &e)) stop("a chain", e.what);
        if (bracket) nh_ideals_bracket(&chain, eta, other, got);
        else nh_ideals_euler_poincare(&chain, eta, beta, got);
        for (size_t i = 0; i < d; i++) *error = fmax(*error, fabs(got[i] - want[i])), *off = fmax(*off, fabs(got[i] - printed[i]));
        nh_ideals_clear(&chain);
        nh_algebra_clear(&g);
    }
    cJSON_Delete(data);
}

/* The example behind (21): in SO(3) x SO(3) x R each factor has the equations beta' = ad*_eta beta of its own. */
static double direct_product(void)
{
    enum { d = 7 };
    static const size_t size[3] = {3, 3, 1}, order[d] = {0, 1, 2, 3, 4, 5, 6};
    static const double eta[d] = {0.3, -0.7, 1.1, 0.9, 0.2, -1.3, 0.6}, beta[d] = {1.2, 0.4, -0.5, -0.8, 1.7, 0.1, 2.3};
    double metric[d * d] = {0}, got[d], worst = 0;
    nh_error e = {0};
    nh_algebra g = nh_algebra_create(d);
    nh_ideals chain;
    for (size_t i = 0; i < d; i++) metric[i * d + i] = 1 + (double)i / 2;
    for (size_t f = 0; f < 6; f += 3)
        for (size_t i = 0; i < 3; i++) {
            size_t a = f + i, b = f + (i + 1) % 3, c = f + (i + 2) % 3;
            g.c[(a * d + b) * d + c] = 1, g.c[(b * d + a) * d + c] = -1;
        }
    if (!nh_ideals_init(&chain, &g, 3, size, order, metric, &e)) stop("a chain", e.what);
    nh_ideals_euler_poincare(&chain, eta, beta, got);
    for (size_t f = 0; f < 6; f += 3)
        for (size_t i = 0; i < 3; i++) {
            size_t b = f + (i + 1) % 3, c = f + (i + 2) % 3;
            worst = fmax(worst, fabs(got[f + i] - (beta[b] * eta[c] - beta[c] * eta[b])));
        }
    nh_ideals_clear(&chain);
    nh_algebra_clear(&g);
    return fmax(worst, fabs(got[6]));
}

/* ---- Euler's disk ---- */

/* Letters T, P, S, and 1, 2 behind @: accelerations of theta, varphi, psi; rates of the two components of eta = r psi' u. */
static nh_ex with_accelerations(const document *d, const char *text)
{
    static char whole[100000];
    static const char *const coordinate[3] = {"d/dtheta'", "d/dvarphi'", "d/dpsi'"};
    char *out = whole;
    for (const char *c = text; *c; c++) {
        const char *letter = *c == '@' ? strchr("TPS12", c[1]) : NULL;
        size_t room = sizeof whole - (size_t)(out - whole);
        if (!letter) *out++ = *c;
        else if (*letter == '1') out += snprintf(out, room, "(-r*((%s)*cos(varphi) - psi'*varphi'*sin(varphi)))", shown(d, "semispray", "Gamma", coordinate[2]));
        else if (*letter == '2') out += snprintf(out, room, "(-r*((%s)*sin(varphi) + psi'*varphi'*cos(varphi)))", shown(d, "semispray", "Gamma", coordinate[2]));
        else out += snprintf(out, room, "(%s)", shown(d, "semispray", "Gamma", coordinate[*letter == 'T' ? 0 : *letter == 'P' ? 1 : 2]));
        c += letter != NULL;
    }
    *out = 0;
    return parsed(d, whole);
}

#define FIRST(inertia) inertia "*(@S + @P*cos(theta) - theta'*varphi'*sin(theta)) + M*r^2*@S + M*r^2*(@P*cos(theta) - 2*theta'*varphi'*sin(theta))" \
    " - M*e*r^2/2*(@P*sin(theta) + 2*theta'*varphi'*cos(theta))"
#define SECOND "2*(M*r^2 + I3 - I1)*theta'*varphi'*sin(theta)*cos(theta) - (I1*sin(theta)^2 + (I3 + M*r^2)*cos(theta)^2)*@P" \
    " + M*r*cos(theta)*(@1*cos(varphi) + @2*sin(varphi)) + I3*(theta'*psi'*sin(theta) - @S*cos(theta))" \
    " - M*r*e/2*(r*e/2*(2*theta'*varphi'*sin(theta)*cos(theta) + @P*sin(theta)^2) + sin(theta)*(@1*cos(varphi) + @2*sin(varphi))" \
    " + 2*r*theta'*varphi'*(sin(theta)^2 - cos(theta)^2) - 2*r*@P*sin(theta)*cos(theta))"
#define THIRD "(I1 - I3 - M*r^2)*varphi'^2*sin(theta)*cos(theta) - I3*psi'*varphi'*sin(theta) - (I1 + M*r^2)*@T" \
    " + M*r*sin(theta)*(@2*cos(varphi) - @1*sin(varphi)) - M*g*r*cos(theta) + M*r*e/2*(r*e/2*varphi'^2*sin(theta)*cos(theta)" \
    " + r*varphi'^2*(sin(theta)^2 - cos(theta)^2) + cos(theta)*(@2*cos(varphi) - @1*sin(varphi)) + g*sin(theta) - r*e/2*@T)"

static double vanishes(const document *d, const char *text)
{
    nh_ex size = parsed(d, "M*r^2*theta'*varphi'"), e = with_accelerations(d, text);
    return differ(d, nh_add(d->system->dag, e, size), size);
}

/* The currents that solve (51), by its accelerations: their rate, beside the largest of its terms. */
static double solves(const document *d, int analyzed, const char *function)
{
    static const char *const coordinate[3][3] = {
        {"theta", "theta'", "@T"}, {"varphi", "varphi'", "@P"}, {"psi", "psi'", "@S"}};
    nh_dag *g = d->system->dag;
    const cJSON *item;
    double worst = INFINITY;
    cJSON_ArrayForEach(item, at(document_of(analyzed)->root, "currents"))
    {
        nh_ex phi, sum = nh_int(g, 0), term = sum;
        if (!strstr(text_at(item, "expression"), function)) continue;
        phi = parsed(d, text_at(item, "expression"));
        for (size_t i = 0; i < 3; i++) {
            nh_ex v = parsed(d, coordinate[i][1]), by_q = nh_diff(g, phi, parsed(d, coordinate[i][0]));
            nh_ex by_v = nh_diff(g, phi, v);
            sum = nh_add(g, sum, nh_add(g, nh_mul(g, by_q, v), nh_mul(g, by_v, with_accelerations(d, coordinate[i][2]))));
            if (i == 0) term = nh_mul(g, by_q, v);
        }
        worst = differ(d, nh_add(g, sum, term), term);
    }
    return worst;
}

#define DISK_LAGRANGIAN "-M*g*r*sin(theta) + (I1 + M*r^2*e^2/4)/2*(theta'^2 + varphi'^2*sin(theta)^2) + M/2*(x1'^2 + x2'^2) + M*r^2*theta'^2/2" \
    " + M*r^2*varphi'^2*cos(theta)^2/2 + M*r*x1'*(theta'*sin(theta)*sin(varphi) - varphi'*cos(theta)*cos(varphi))" \
    " - M*r*x2'*(theta'*cos(varphi)*sin(theta) + varphi'*cos(theta)*sin(varphi)) + I3/2*(varphi'*cos(theta) + psi')^2" \
    " + M*r*e/2*(x1'*(varphi'*cos(varphi)*sin(theta) + theta'*sin(varphi)*cos(theta)) + x2'*(varphi'*sin(varphi)*sin(theta) - theta'*cos(theta)*cos(varphi))" \
    " - r*cos(theta)*sin(theta)*varphi'^2) - M*g*r*e/2*cos(theta)"

/* Lines of the form beside that of psi1, psi2. */
static double other_upsilon(const document *d)
{
    const cJSON *line;
    double count = 0;
    shown(d, "0.gyroscopic_form", "Upsilon_psi1,psi2", "psi1'");
    cJSON_ArrayForEach(line, section_of(d, "0.gyroscopic_form"))
        count += !strncmp(text_at(line, "label"), "Upsilon_", 8) && strcmp(text_at(line, "label"), "Upsilon_psi1,psi2");
    return count;
}

/* alpha_theta = theta (dphi1 + a_1 dpsi1 + a_2 dpsi2): d a_2/dpsi1 - d a_1/dpsi2 = Xi, with a_i functions of the shape alone. */
static double basic(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex a1 = coefficient(d, "1.hamiltonian", "phat_psi1", "theta_1"), a2 = coefficient(d, "1.hamiltonian", "phat_psi2", "theta_1");
    nh_ex phi1 = parsed(d, "phi1"), xi = coefficient(d, "1.magnetic_form", "Xi_psi1,psi2", "theta_1");
    if (nh_depends(g, a1, phi1) || nh_depends(g, a2, phi1)) return INFINITY;
    return differ(d, nh_sub(g, nh_diff(g, a2, parsed(d, "psi1")), nh_diff(g, a1, parsed(d, "psi2"))), xi);
}

/* Helmholtz's condition dF_i/dq'_j + dF_j/dq'_i = 0 of a force without accelerations, for i = j = x: by what it is violated. */
static double helmholtz(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex slope = nh_diff(g, coefficient(d, "chetaev_equations", "F_x", ""), parsed(d, "x'"));
    return differ(d, nh_mul(g, nh_int(g, 2), slope), parsed(d, "-2*(k^2 - 1)/k^2*m*phi'*tan(phi)"));
}

#include "bench_papers_figures.h"

#include "graph/dag.h"
#include "graph/node.h"

/* ---- by name ---- */

static void by(const row *r, const document *d, double *printed, double *meant, char *value, size_t size)
{
    const char *what = r->label;
    if (!strcmp(what, "euler")) *printed = euler(d);
    else if (!strcmp(what, "helmholtz")) *printed = helmholtz(d);
    else if (!strcmp(what, "projection")) *printed = projection(d);
    else if (!strcmp(what, "chetaev")) *printed = chetaev(d);
    else if (!strcmp(what, "chetaev field")) *printed = chetaev_field(d);
    else if (!strcmp(what, "F")) *printed = lie_form(d);
    else if (!strcmp(what, "current")) *printed = current_of_field(d);
    else if (!strcmp(what, "15")) *printed = equation_15(d), *meant = violation(d, "15", NULL);
    else if (!strcmp(what, "semiholonomic")) *printed = semiholonomic(d);
    else if (!strcmp(what, "22")) equation_22(d, printed, meant);
    else if (!strcmp(what, "24")) equation_24(d, printed, meant);
    else if (!strcmp(what, "32")) equation_32(d, printed, meant);
    else if (!strcmp(what, "34")) *printed = equation_34(d);
    else if (!strcmp(what, "33") || !strcmp(what, "37") || !strcmp(what, "38")) *printed = motion(d, atoi(what));
    else if (!strcmp(what, "crane metric")) *printed = crane_metric();
    else if (!strcmp(what, "crane hamiltonian")) *printed = crane_hamiltonian(d);
    else if (!strcmp(what, "upsilon")) *printed = upsilon(d);
    else if (!strcmp(what, "other upsilon")) *printed = other_upsilon(d);
    else if (!strcmp(what, "basic")) *printed = basic(d);
    else if (!strcmp(what, "figure")) *printed = figure(d, atoi(r->of));
    else if (!strcmp(what, "bracket")) stages(true, (size_t)atoi(r->of), printed, meant), *meant = INFINITY;
    else if (!strcmp(what, "euler-poincare") && !strcmp(r->of, "whole")) stages(false, 9, printed, meant), *meant = INFINITY;
    else if (!strcmp(what, "euler-poincare")) stages(false, 9, meant, printed);
    else if (!strcmp(what, "direct product")) *printed = direct_product();
    else if (!strcmp(what, "solves")) *printed = solves(document_of(D_ROLLING), r->document, r->of);
    else if (!strcmp(what, "disk lagrangian")) *printed = differ(d, parsed(d, DISK_LAGRANGIAN), d->system->lagrangian);
    else if (!strcmp(what, "disk") && r->of[0] == '1') *printed = vanishes(d, FIRST("r*I3")), *meant = vanishes(d, FIRST("I3"));
    else if (!strcmp(what, "disk")) *printed = vanishes(d, r->of[0] == '2' ? SECOND : THIRD);
    else stop("no computation", what);
    snprintf(value, size, "differs by %.1e", *meant < *printed ? *meant : *printed);
}

#endif
