// What the layouts of roofline.cpp share: vectors, the formula, the cell sort and the pair list.
#pragma once
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>
#ifdef __AVX2__
#include <immintrin.h>
#endif

// The vectors of GCC 12 and Clang: plain arithmetic on 4 or 8 numbers, whatever the processor.
template <int L> struct LanesOf { typedef double type __attribute__((vector_size(8 * L))); };
template <int L> using Lanes = typename LanesOf<L>::type;
template <class V> constexpr int lanes = sizeof(V) / sizeof(double);

template <class V> V load(const double* from) {
  V value;
  std::memcpy(&value, from, sizeof value);
  return value;
}
template <class V> void store(double* to, V value) { std::memcpy(to, &value, sizeof value); }
inline double root(double a) { return std::sqrt(a); }
template <class V> V root(V a) {
  for (int l = 0; l < lanes<V>; l++) a[l] = std::sqrt(a[l]);
  return a;
}
inline double total(double a) { return a; }
template <class V> double total(V a) {
  double sum = 0;
  for (int l = 0; l < lanes<V>; l++) sum += a[l];
  return sum;
}

// One particle or a vector of them, or (of pointers) the columns of all; p: pressure / density^2, q: 1 / density.
template <class V> struct State { V x, y, u, v, p, q; };
typedef State<double*> Columns;
template <class V> State<V> load(const Columns& all, int j) {
  return {load<V>(all.x + j), load<V>(all.y + j), load<V>(all.u + j),
          load<V>(all.v + j), load<V>(all.p + j), load<V>(all.q + j)};
}
template <class V> State<V> repeated(const Columns& all, int i) {
  return {V{} + all.x[i], V{} + all.y[i], V{} + all.u[i], V{} + all.v[i], V{} + all.p[i], V{} + all.q[i]};
}

struct Formula {
  double inverse_support, eta2, two_mu, scale;
  // The force of j on i but for the constant `scale`, added to x and y.
  template <class V> void operator()(const State<V>& i, const State<V>& j, V& x, V& y) const {
    V dx = i.x - j.x, dy = i.y - j.y, r2 = dx * dx + dy * dy;
    V far = 1.0 - root(r2) * inverse_support;
    far = far > 0 ? far : V{};
    V factor = far * far * far, pressure = i.p + j.p, viscous = two_mu * i.q * j.q * r2 / (r2 + eta2);
    x = factor * (viscous * (i.u - j.u) - pressure * dx);
    y = factor * (viscous * (i.v - j.v) - pressure * dy);
  }
};

template <class T> T* room(size_t count) {  // aligned to cache lines, zero, kept until the program ends
  size_t bytes = (count + 64) * sizeof(T) / 64 * 64;
  return static_cast<T*>(std::memset(std::aligned_alloc(64, bytes), 0, bytes));
}

// Particles of the unit square in the order of their cells, whose width is the support over `reach`; the grid has an
// empty border of `reach` cells.
struct Cells {
  int n, reach, across;
  double support;
  int *cell, *order, *start;
  Columns given, sorted;

  void sort() {
    double inverse = reach / (support * (1 + 1e-9));
    across = int(inverse) + 1 + 2 * reach;
    std::memset(start, 0, sizeof(int) * (across * across + 1));
    auto number = [&](int i) { return (int(given.y[i] * inverse) + reach) * across + int(given.x[i] * inverse) + reach; };
    for (int i = 0; i < n; i++) start[number(i) + 1]++;
    for (int c = 0; c < across * across; c++) start[c + 1] += start[c];
    std::vector<int> next(start, start + across * across);
    for (int i = 0; i < n; i++) {
      int j = next[number(i)]++;
      order[j] = i, cell[j] = number(i);
      sorted.x[j] = given.x[i], sorted.y[j] = given.y[i], sorted.u[j] = given.u[i];
      sorted.v[j] = given.v[i], sorted.p[j] = given.p[i], sorted.q[j] = given.q[i];
    }
    sorted.x[n] = sorted.y[n] = 1e9;
  }
  // The candidates of particle i in a row of cells; of each pair once: those behind i, and the rows above.
  int begin(int i, int row) const { return start[cell[i] + row * across - reach]; }
  int end(int i, int row) const { return start[cell[i] + row * across + reach + 1]; }
  int begin_once(int i, int row) const { return row ? begin(i, row) : i + 1; }
};

struct PairList {
  size_t capacity;
  int *first, *neighbour;

  // Four candidates at a time; a table packs those within the support to the left.
  void build(const Cells c, bool once) const {
    alignas(16) static int table[16][4];
    for (int bits = 0; bits < 16; bits++)
      for (int l = 0, k = 0; l < 4; l++)
        if (bits >> l & 1) table[bits][k++] = l;
    int count = 0;
    for (int i = 0; i < c.n; i++) {
      first[i] = count;
      if (count + 1000ul > capacity) std::abort();
      auto x = Lanes<4>{} + c.sorted.x[i], y = Lanes<4>{} + c.sorted.y[i];
      for (int row = once ? 0 : -c.reach; row <= c.reach; row++)
        for (int j = once ? c.begin_once(i, row) : c.begin(i, row), stop = c.end(i, row); j < stop; j += 4) {
          auto dx = x - load<Lanes<4>>(c.sorted.x + j), dy = y - load<Lanes<4>>(c.sorted.y + j), r2 = dx * dx + dy * dy;
          auto near = (r2 < c.support * c.support) & (r2 > 0);
#ifdef __AVX2__
          int bits = _mm256_movemask_pd((__m256d)near);
#else
          int bits = (near[0] & 1) | (near[1] & 2) | (near[2] & 4) | (near[3] & 8);
#endif
          if (stop - j < 4) bits &= (1 << (stop - j)) - 1;
          for (int l = 0; l < 4; l++) neighbour[count + l] = j + table[bits][l];
          count += __builtin_popcount(bits);
        }
    }
    first[c.n] = count;
  }
};
