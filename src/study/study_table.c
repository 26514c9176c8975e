/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Results as tables: one row a case, and one row a sample of a case's history. The columns are a contract. */
#include <gridcross/study.h>

#include <math.h>
#include <stdarg.h>
#include <string.h>

static const char *const norms[GX_NORMS] = {[GX_INF] = "inf", [GX_RMS] = "rms", [GX_L2N] = "l2n"};

/* One statement a column serves three passes: counting columns (no table), naming them, and filling a row. */
struct cursor {
  struct gx_table *table;
  bool naming;
  size_t row, column;
  int failed;
  char name[80];
};

/* Only the pass that names columns needs names: printing them would be most of filling a row. */
__attribute__((format(printf, 2, 3))) static const char *named(struct cursor *at, const char *format, ...)
{
  if (!at->naming) return "";
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(at->name, sizeof at->name, format, arguments);
  va_end(arguments);
  return at->name;
}

static void put(struct cursor *at, const char *name, const char *unit, enum gx_type type, struct gx_value value)
{
  if (at->table && at->naming) at->failed |= gx_table_column(at->table, at->column, name, unit, type);
  if (at->table && !at->naming) at->failed |= gx_table_set(at->table, at->row, at->column, value);
  at->column++;
}

static void put_text(struct cursor *at, const char *name, const char *text)
{
  put(at, name, "", GX_TEXT, text && *text ? (struct gx_value){.type = GX_TEXT, .text = text} : (struct gx_value){0});
}

static void put_real(struct cursor *at, const char *name, const char *unit, double real)
{
  put(at, name, unit, GX_REAL, gx_value_from(real));
}

static void put_count(struct cursor *at, const char *name, double count)
{
  bool fits = fabs(count) < 9e18; /* false for NaN */
  put(at, name, "", GX_INTEGER,
      fits ? (struct gx_value){.type = GX_INTEGER, .integer = (long)count} : (struct gx_value){.type = GX_NULL});
}

static void put_errors(struct cursor *at, const char *prefix, const char *moment, const double error[GX_QUANTITIES][GX_NORMS],
                       int quantity, bool valid)
{
  for (int n = 0; n < GX_NORMS; n++)
    put_real(at, named(at, "%s%s%s.%s", prefix, gx_measure_quantity[quantity].name, moment, norms[n]),
             gx_measure_quantity[quantity].unit, valid ? error[quantity][n] : NAN);
}

static void put_norm(struct cursor *at, const char *prefix, int norm, double length)
{
  put_real(at, named(at, "%s.%s", prefix, norms[norm]), "m", length);
}

/* Of the last spectrum, and how the part above Nyquist's wavenumber has grown. */
static void put_spectrum(struct cursor *at, const struct gx_result *result, enum gx_quantity quantity)
{
  const struct gx_spectra *spectra = &result->spectra;
  double nyquist = spectra->nyquist, half = 0.5 * spectra->spacing;
  const struct {
    const char *name;
    double low, high;
  } band[] = {{"below", -1, nyquist}, {"above", nyquist, INFINITY}, {"driven", spectra->driven - half, spectra->driven + half}};
  bool any = result->outcome.status == GX_OK && spectra->samples;
  for (size_t i = 0; i < sizeof band / sizeof *band; i++)
    put_real(at, named(at, "result.spectrum.%s.%s", gx_measure_quantity[quantity].name, band[i].name),
             gx_measure_quantity[quantity].unit,
             any ? gx_spectrum_band(spectra, spectra->samples - 1, quantity, band[i].low, band[i].high) : NAN);
  put_real(at, named(at, "result.spectrum.%s.growth", gx_measure_quantity[quantity].name), "1/s",
           any ? gx_spectrum_growth(spectra, quantity, nyquist, INFINITY) : NAN);
}

static void put_frequency(struct cursor *at, const struct gx_result *result)
{
  bool ok = result->outcome.status == GX_OK;
  double ratio = ok ? result->vibration.frequency / result->frequency : NAN;
  put_real(at, "result.frequency", "1/s", ok ? result->vibration.frequency : NAN);
  put_real(at, "result.frequency.ratio", "", ratio);
  put_real(at, "result.frequency.error", "", fabs(ratio - 1));
  put_real(at, "result.frequency.growth", "1/s", ok ? result->vibration.growth : NAN);
  put_real(at, "result.frequency.kh", "", isfinite(ratio) ? result->kh : NAN);
}

static void put_budget(struct cursor *at, const char *prefix, const struct gx_budget_values *budget, bool valid)
{
  for (int i = 0; i < GX_BUDGET_ENTRIES; i++)
    put_real(at, named(at, "%sbudget.%s", prefix, gx_budget_columns[i].name), gx_budget_columns[i].unit,
             valid ? budget->value[i] : NAN);
}

static void put_case(struct cursor *at, const struct gx_case *one, const struct gx_result *result, bool timing)
{
  enum gx_status status = result->outcome.status;
  const struct gx_measured *measured = &result->measured;
  bool ran = status != GX_REFUSED, ok = status == GX_OK;
  put_text(at, "case", one->id);
  for (int p = 0; p < GX_PARAMETERS; p++)
    put(at, gx_parameters[p].path, gx_parameters[p].unit, gx_parameters[p].type, one->value[p]);
  put_text(at, "result.status", gx_status_name(status));
  put_text(at, "result.reason", result->outcome.reason);
  put_count(at, "result.particle", ok || result->outcome.particle < 0 ? NAN : (double)result->outcome.particle);
  put_real(at, "result.dt", "s", ran ? result->dt : NAN);
  put_count(at, "result.steps", ran ? result->steps : NAN);
  put_real(at, "result.time", "s", ran ? result->time : NAN);
  put_count(at, "result.crossings", ran ? measured->last.crossings : NAN);
  for (int q = 0; q < GX_QUANTITIES; q++) {
    put_errors(at, "result.", ".final", measured->last.error, q, ok);
    put_errors(at, "result.", ".max", measured->max_error, q, ok);
  }
  put_real(at, "result.energy.defect", "J", ok ? measured->max_defect : NAN);
  put_real(at, "result.energy.drift", "", ok ? measured->drift : NAN);
  put_real(at, "result.momentum.linear", "", ok ? measured->momentum_change : NAN);
  put_real(at, "result.momentum.angular", "", ok ? measured->angular_change : NAN);
  put_real(at, "result.restitution", "", ok ? result->restitution : NAN);
  for (int q = 0; q < GX_QUANTITIES; q++) put_errors(at, "result.", ".reference", result->reference, q, ok);
  for (int n = 0; n < GX_NORMS; n++) put_norm(at, "result.jump.final", n, ok ? measured->last.jump[n] : NAN);
  for (int n = 0; n < GX_NORMS; n++) put_norm(at, "result.jump.max", n, ok ? measured->max_jump[n] : NAN);
  put_real(at, "result.jump.last", "m", ok ? measured->last_jump : NAN);
  put_real(at, "result.jump.estimate", "m", ok ? measured->estimated_jump : NAN);
  put_count(at, "result.probe.particle", ran && one->value[GX_OUTPUT_PROBE].type == GX_TEXT ? (double)result->probe : NAN);
  put_real(at, "result.probe.acceleration_change", "m/s^2", ok ? measured->probe_change : NAN);
  put_real(at, "result.probe.displacement.max", "m", ok ? measured->probe_displacement : NAN);
  for (int q = 0; q < GX_QUANTITIES; q++) put_spectrum(at, result, (enum gx_quantity)q);
  put_frequency(at, result);
  put_budget(at, "result.", &result->budget, ran);
  put_count(at, "result.quadrature.left_cells", result->left_cells);
  put_real(at, "result.stable_dt", "s", ran ? result->stable_dt : NAN);
  if (!timing) return;
  put_real(at, "result.seconds", "s", ran ? result->seconds : NAN);
  put_real(at, "result.ns_per_particle_step", "ns", ran ? result->ns_per_particle_step : NAN);
}

/* Linear momentum by component; angular momentum: none in 1-D, along z in 2-D, a vector in 3-D. */
static void put_momentum(struct cursor *at, int dim, const struct gx_sample *sample)
{
  for (int d = 0; d < dim; d++) put_real(at, named(at, "momentum.%c", "xyz"[d]), "kg m/s", sample->momentum[d]);
  for (int d = dim == 3 ? 0 : 2; d < GX_MAX_DIM && dim > 1; d++)
    put_real(at, named(at, "angular.%c", "xyz"[d]), "kg m^2/s", sample->angular[d]);
}

/* One column in 1-D, one a component in 2-D and 3-D. */
static void put_vector(struct cursor *at, const char *name, const char *unit, int dim, const double *vector)
{
  for (int d = 0; d < dim; d++) put_real(at, dim > 1 ? named(at, "%s.%c", name, "xyz"[d]) : name, unit, vector[d]);
}

static void put_jumps(struct cursor *at, const struct gx_sample *sample)
{
  put_real(at, "jump.step", "m", sample->jump_step);
  for (int n = 0; n < GX_NORMS; n++) put_norm(at, "jump", n, sample->jump[n]);
}

static void put_probe(struct cursor *at, int dim, bool jumps, const struct gx_probe *probe)
{
  put_vector(at, "probe.displacement", "m", dim, probe->u);
  put_vector(at, "probe.velocity", "m/s", dim, probe->v);
  put_vector(at, "probe.acceleration", "m/s^2", dim, probe->a);
  put_vector(at, "probe.displacement_error", "m", dim, probe->u_error);
  put_vector(at, "probe.velocity_error", "m/s", dim, probe->v_error);
  if (jumps) put_vector(at, "probe.jump", "m", dim, probe->jump);
}

static void put_sample(struct cursor *at, int dim, const struct gx_sample *sample)
{
  put_real(at, "time", "s", sample->time);
  for (int q = 0; q < GX_QUANTITIES; q++) put_errors(at, "", "", sample->error, q, true);
  put_real(at, "energy.kinetic", "J", sample->kinetic);
  put_real(at, "energy.kinetic_nodes", "J", sample->kinetic_nodes);
  put_real(at, "energy.elastic", "J", sample->elastic);
  put_real(at, "energy.work", "J", sample->work);
  put_real(at, "energy.defect", "J", sample->defect);
  put_momentum(at, dim, sample);
  put_real(at, "crossings", "", sample->crossings);
}

static void put_bin(struct cursor *at, const struct gx_spectra *spectra, size_t sample, size_t bin)
{
  put_real(at, "time", "s", spectra->time ? spectra->time[sample] : NAN);
  put_real(at, "wavenumber", "1/m", (double)bin * spectra->spacing);
  for (size_t q = 0; q < GX_QUANTITIES; q++)
    put_real(at, gx_measure_quantity[q].name, gx_measure_quantity[q].unit,
             spectra->rms ? spectra->rms[(sample * GX_QUANTITIES + q) * spectra->bins + bin] : NAN);
}

static struct gx_table *finish(struct cursor *at)
{
  if (!at->failed) return at->table;
  gx_table_free(at->table);
  return NULL;
}

static void widen(struct gx_table *table, const char *name, const char *text)
{
  struct gx_column *column = &table->column[gx_table_find(table, name)];
  if (strlen(text) > column->width) column->width = strlen(text);
}

/* Of texts that are some of a few. */
static void set_widths(struct gx_table *table)
{
  table->column[gx_table_find(table, "case")].width = GX_ID_LENGTH - 1;
  for (int status = GX_OK; status <= GX_FAILED; status++) widen(table, "result.status", gx_status_name((enum gx_status)status));
  for (int p = 0; p < GX_PARAMETERS; p++)
    for (int i = 0; gx_parameters[p].choice && gx_parameters[p].choice(i); i++)
      widen(table, gx_parameters[p].path, gx_parameters[p].choice(i));
}

struct gx_table *gx_study_table_begin(size_t rows, bool timing)
{
  static const struct gx_case no_case;
  static const struct gx_result no_result;
  struct cursor at = {0};
  put_case(&at, &no_case, &no_result, timing);
  at = (struct cursor){.table = gx_table_create(at.column, rows), .naming = true};
  if (!at.table) return NULL;
  put_case(&at, &no_case, &no_result, timing);
  if (!at.failed) set_widths(at.table);
  return finish(&at);
}

int gx_study_table_fill(struct gx_table *table, size_t row, const struct gx_case *one, const struct gx_result *result,
                        bool timing)
{
  struct cursor at = {.table = table, .row = row};
  put_case(&at, one, result, timing);
  return at.failed;
}

struct gx_table *gx_study_table(const struct gx_study *study, const struct gx_result *results, bool timing)
{
  struct gx_table *table = gx_study_table_begin(study->count, timing);
  int failed = 0;
  for (size_t i = 0; table && i < study->count && !failed; i++)
    failed = gx_study_table_fill(table, i, &study->cases[i], &results[i], timing);
  if (!failed) return table;
  gx_table_free(table);
  return NULL;
}

static void put_row(struct cursor *at, const struct gx_history *history, const struct gx_sample *sample,
                    const struct gx_probe *probe, const struct gx_budget_values *budget)
{
  put_sample(at, history->dim, sample);
  if (history->jumps) put_jumps(at, sample);
  if (history->probe) put_probe(at, history->dim, history->jumps, probe);
  if (history->budget) put_budget(at, "", budget, true);
}

struct gx_table *gx_study_table_history(const struct gx_result *result)
{
  static const struct gx_sample no_sample;
  static const struct gx_probe no_probe;
  static const struct gx_budget_values no_budget;
  const struct gx_history *history = &result->history;
  struct cursor at = {0};
  put_row(&at, history, &no_sample, &no_probe, &no_budget);
  at = (struct cursor){.table = gx_table_create(at.column, history->samples), .naming = true};
  if (!at.table) return NULL;
  put_row(&at, history, &no_sample, &no_probe, &no_budget);
  at.naming = false;
  for (at.row = 0; at.row < history->samples; at.row++) {
    at.column = 0;
    size_t row = at.row;
    put_row(&at, history, &history->sample[row], history->probe ? &history->probe[row] : NULL,
            history->budget ? &history->budget[row] : NULL);
  }
  return finish(&at);
}

struct gx_table *gx_study_table_spectra(const struct gx_result *result)
{
  static const struct gx_spectra no_spectra;
  const struct gx_spectra *spectra = &result->spectra;
  struct cursor at = {0};
  put_bin(&at, &no_spectra, 0, 0);
  at = (struct cursor){.table = gx_table_create(at.column, spectra->samples * spectra->bins), .naming = true};
  if (!at.table) return NULL;
  put_bin(&at, &no_spectra, 0, 0);
  at.naming = false;
  for (at.row = 0; at.row < spectra->samples * spectra->bins; at.row++) {
    at.column = 0;
    put_bin(&at, spectra, at.row / spectra->bins, at.row % spectra->bins);
  }
  return finish(&at);
}
