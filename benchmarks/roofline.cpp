// Pressure gradient and Morris viscosity, hand-written over the memory layouts that particle codes use; sweep.py
// builds, checks and times it. 2-D, open space, Wendland C2, float64, one core:
//
//   du_i/dt = sum_j m F(r) (2 mu / (rho_i rho_j) r^2 / (r^2 + eta^2) u_ij - (p_i / rho_i^2 + p_j / rho_j^2) r_ij)
//
// roofline PARTICLES [RESULTS] prints "step lanes cells-a-support seconds" lines, many times over, or once with RESULTS,
// where it then writes the accelerations known after each step: all x, then all y, in the order of the input.
#include "roofline.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>

struct Accelerations {
  double *x, *y, scale;
  template <class V> void set(int i, V sx, V sy) { x[i] = scale * total(sx), y[i] = scale * total(sy); }
};

// Cells, each pair twice. One lane leaves the vectors to the compiler; more run past a row, where nothing is near.
template <class V> void cells(const Cells c, const Formula force, Accelerations out) {
  for (int i = 0; i < c.n; i++) {
    const auto own = repeated<V>(c.sorted, i);
    V fx, fy, x{}, y{};
    for (int row = -c.reach; row <= c.reach; row++)
      for (int j = c.begin(i, row), stop = c.end(i, row); j < stop; j += lanes<V>)
        force(own, load<V>(c.sorted, j), fx, fy), x += fx, y += fy;
    out.set(i, x, y);
  }
}

// Cells, each pair once: the force is subtracted from the neighbours' sums, which lie side by side.
template <class V> void cells_once(const Cells c, const Formula force, Accelerations out) {
  std::fill(out.x, out.x + c.n, 0.0), std::fill(out.y, out.y + c.n, 0.0);
  for (int i = 0; i < c.n; i++) {
    const auto own = repeated<V>(c.sorted, i);
    V fx, fy, x{}, y{};
    for (int row = 0; row <= c.reach; row++)
      for (int j = c.begin_once(i, row), stop = c.end(i, row); j < stop; j += lanes<V>) {
        force(own, load<V>(c.sorted, j), fx, fy), x += fx, y += fy;
        store(out.x + j, load<V>(out.x + j) - fx), store(out.y + j, load<V>(out.y + j) - fy);
      }
    out.set(i, out.x[i] + total(x), out.y[i] + total(y));
  }
}

// The pair list, as a compiler takes it: gathers.
void list_gathered(const Cells c, const PairList list, const Formula force, Accelerations out) {
  for (int i = 0; i < c.n; i++) {
    const auto own = repeated<double>(c.sorted, i);
    double fx, fy, x = 0, y = 0;
    for (size_t k = list.first[i]; k < list.first[i + 1]; k++)
      force(own, load<double>(c.sorted, list.neighbour[k]), fx, fy), x += fx, y += fy;
    out.set(i, x, y);
  }
}

// visit(numbers of four neighbours), with the far particle behind all others in place of those beyond the last.
template <class Visit> void by_fours(const PairList& list, int i, int beyond, Visit visit) {
  const int *k = list.neighbour + list.first[i], *stop = list.neighbour + list.first[i + 1];
  for (; k + 4 <= stop; k += 4) visit(k);
  if (k == stop) return;
  int rest[4];
  for (int l = 0; l < 4; l++) rest[l] = k + l < stop ? k[l] : beyond;
  visit(rest);
}

void list_records(const Cells c, const PairList list, const double* records, const Formula force, Accelerations out) {
  for (int i = 0; i < c.n; i++) {
    const auto own = repeated<Lanes<4>>(c.sorted, i);
    Lanes<4> fx, fy, x{}, y{};
    by_fours(list, i, c.n, [&](const int* j) { force(own, others(records, j), fx, fy), x += fx, y += fy; });
    out.set(i, x, y);
  }
}

// The list of each pair once: records in, and the forces subtracted from the neighbours' sums (x, y).
void list_records_once(const Cells c, const PairList half, const double* records, double* sums, const Formula force,
                       Accelerations out) {
  std::fill(sums, sums + 2 * c.n, 0.0);
  for (int i = 0; i < c.n; i++) {
    const auto own = repeated<Lanes<4>>(c.sorted, i);
    Lanes<4> fx, fy, x{}, y{};
    by_fours(half, i, c.n, [&](const int* j) {
      force(own, others(records, j), fx, fy), x += fx, y += fy;
      auto subtract = [&](int j, Lanes<2> f) { store(sums + 2 * j, load<Lanes<2>>(sums + 2 * j) - f); };
      auto even = __builtin_shufflevector(fx, fy, 0, 4, 2, 6), odd = __builtin_shufflevector(fx, fy, 1, 5, 3, 7);
      subtract(j[0], __builtin_shufflevector(even, even, 0, 1));
      subtract(j[1], __builtin_shufflevector(odd, odd, 0, 1));
      subtract(j[2], __builtin_shufflevector(even, even, 2, 3));
      subtract(j[3], __builtin_shufflevector(odd, odd, 2, 3));
    });
    out.set(i, sums[2 * i] + total(x), sums[2 * i + 1] + total(y));
  }
}

double now() {  // the processor's time spent on this program
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return time.tv_sec + 1e-9 * time.tv_nsec;
}

int main(int count, char** arguments) {
  double head[5];  // particles, support, eta^2, 2 mu, -mass times the kernel's factor
  FILE* file = std::fopen(arguments[1], "rb");
  if (!file || std::fread(head, 8, 5, file) != 5) return 1;
  const int n = head[0];
  const Formula force{1 / head[1], head[2], head[3]};
  auto column = [&] { return room<double>(n); };
  auto columns = [&] { return Columns{column(), column(), column(), column(), column(), column()}; };
  Cells c{n, 1, 0, head[1], room<int>(n), room<int>(n), room<int>(40 * size_t(n) + 10000), columns(), columns()};
  for (double* given : {c.given.x, c.given.y, c.given.u, c.given.v, c.given.p, c.given.q})
    if (std::fread(given, 8, n, file) != size_t(n)) return 1;
  const size_t most = 60 * size_t(n) + 10000;
  const PairList list{most, room<size_t>(n), room<int>(most)}, half{most, room<size_t>(n), room<int>(most)};
  const Accelerations out{column(), column(), head[4]};
  double *records = room<double>(8 * size_t(n + 1)), *sums = room<double>(2 * size_t(n + 1));

  struct Step { const char* name; int lanes; std::function<void()> run; };
  const Step steps[] = {
      {"sort", 1, [&] { c.sort(); }},
      {"build", 4, [&] { list.build(c, false); }},
      {"build_half", 4, [&] { half.build(c, true); }},
      {"pack", 1, [&] { pack(c, records); }},
      {"cell_auto", 1, [&] { cells<double>(c, force, out); }},
      {"cell_vec", 4, [&] { cells<Lanes<4>>(c, force, out); }},
      {"cell_vec", 8, [&] { cells<Lanes<8>>(c, force, out); }},
      {"sym_vec", 4, [&] { cells_once<Lanes<4>>(c, force, out); }},
      {"sym_vec", 8, [&] { cells_once<Lanes<8>>(c, force, out); }},
      {"csr_gather", 1, [&] { list_gathered(c, list, force, out); }},
      {"csr_aos", 4, [&] { list_records(c, list, records, force, out); }},
      {"half_aos", 4, [&] { list_records_once(c, half, records, sums, force, out); }},
  };
  FILE* results = count > 2 ? std::fopen(arguments[2], "wb") : nullptr;
  std::vector<double> original(n);
  for (c.reach = 1; c.reach <= 3; c.reach++)
    for (int round = 0; round < (results ? 1 : 4); round++)
      for (const auto& [name, lanes, run] : steps) {
        const double begin = now();
        run();
        std::printf("%s %d %d %.9f\n", name, lanes, c.reach, now() - begin);
        if (!results) continue;
        for (const double* sorted : {out.x, out.y}) {
          for (int i = 0; i < n; i++) original[c.order[i]] = sorted[i];
          std::fwrite(original.data(), 8, n, results);
        }
      }
}
