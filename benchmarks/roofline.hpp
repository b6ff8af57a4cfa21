// What the layouts of roofline.cpp share: vectors, the formula, the cell sort, records and the pair list.
#pragma once
#include <immintrin.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

// The vectors of GCC 12 and Clang: plain arithmetic on 4 or 8 numbers.
template <int L> struct LanesOf { typedef double type __attribute__((vector_size(8 * L))); };
template <int L> using Lanes = typename LanesOf<L>::type;
template <class V> constexpr int lanes = sizeof(V) / sizeof(double);

template <class V, class T> V load(const T* from) {
  V value;
  std::memcpy(&value, from, sizeof value);
  return value;
}
template <class V, class T> void store(T* to, V value) { std::memcpy(to, &value, sizeof value); }
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
    auto number = [&](int i) {
      return (int(given.y[i] * inverse) + reach) * across + int(given.x[i] * inverse) + reach;
    };
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
  // The candidates of particle i in a row of cells; those of each pair once are behind i, and in the rows above.
  int begin(int i, int row) const { return start[cell[i] + row * across - reach]; }
  int end(int i, int row) const { return start[cell[i] + row * across + reach + 1]; }
  int begin_once(int i, int row) const { return row ? begin(i, row) : i + 1; }
};

// Records of 8 numbers a particle, one cache line: loaded whole, four are transposed in registers.
inline void pack(const Cells c, double* records) {
  for (int i = 0; i <= c.n; i++) {
    const auto one = load<double>(c.sorted, i);
    std::memcpy(records + 8 * i, &one, sizeof one);
  }
}
inline void transposed(const double* records, const int* j, Lanes<4>* to) {
  auto a = load<Lanes<4>>(records + 8 * j[0]), b = load<Lanes<4>>(records + 8 * j[1]);
  auto c = load<Lanes<4>>(records + 8 * j[2]), d = load<Lanes<4>>(records + 8 * j[3]);
  auto ab = __builtin_shufflevector(a, b, 0, 4, 2, 6), cd = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  to[0] = __builtin_shufflevector(ab, cd, 0, 1, 4, 5), to[2] = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  ab = __builtin_shufflevector(a, b, 1, 5, 3, 7), cd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  to[1] = __builtin_shufflevector(ab, cd, 0, 1, 4, 5), to[3] = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}
inline State<Lanes<4>> others(const double* records, const int* j) {
  Lanes<4> column[8];
  transposed(records, j, column), transposed(records + 4, j, column + 4);
  return {column[0], column[1], column[2], column[3], column[4], column[5]};
}

struct PairList {
  size_t capacity;
  size_t* first;
  int* neighbour;

  // Four candidates at a time; a table packs those within the support to the left.
  void build(const Cells c, bool once) const {
    typedef int Numbers __attribute__((vector_size(16)));
    int table[16][4] = {};
    for (int bits = 0; bits < 16; bits++)
      for (int l = 0, k = 0; l < 4; l++)
        if (bits >> l & 1) table[bits][k++] = l;
    size_t count = 0;
    for (int i = 0; i < c.n; i++) {
      first[i] = count;
      if (count + 1000 > capacity) std::abort();
      const auto x = Lanes<4>{} + c.sorted.x[i], y = Lanes<4>{} + c.sorted.y[i];
      auto add = [&](int j, int stop) {
        for (; j < stop; j += 4) {
          auto dx = x - load<Lanes<4>>(c.sorted.x + j), dy = y - load<Lanes<4>>(c.sorted.y + j), r2 = dx * dx + dy * dy;
          int bits = _mm256_movemask_pd((__m256d)(r2 < c.support * c.support));
          if (stop - j < 4) bits &= (1 << (stop - j)) - 1;
          store(neighbour + count, load<Numbers>(table[bits]) + j);
          count += __builtin_popcount(bits);
        }
      };
      for (int row = once ? 1 : -c.reach; row <= c.reach; row++)
        if (row) add(c.begin(i, row), c.end(i, row));
      if (!once) add(c.begin(i, 0), i);
      add(i + 1, c.end(i, 0));
    }
    first[c.n] = count;
  }
};
