// A whole weakly compressible step, hand-written: equation of state, continuity, pressure and Morris viscosity, update,
// counting sort and periodic images. step.py builds it and runs it beside sphear. 2-D, unit box, Wendland C2 with
// support 3 dx, float64, one core; cells of 1/K supports, each pair once, four neighbours at a time.
//
//   drho_i/dt = sum_j m F u_ij . r_ij
//   du_i/dt = sum_j m F (2 mu / (rho_i rho_j) r^2 / (r^2 + eta^2) u_ij - (p_i / rho_i^2 + p_j / rho_j^2) r_ij)
//
// whole_step SIDE STEPS prints the least seconds a step for K = 1, 2 and 3, and the kinetic energy over the first.
#include <immintrin.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

using Lanes = __m256d;
using Numbers = std::vector<double>;

static double total(Lanes a) {
  double x[4];
  _mm256_storeu_pd(x, a);
  return (x[0] + x[1]) + (x[2] + x[3]);
}

struct State {
  Numbers x, y, u, v, rho;
  void resize(size_t size) {
    for (auto field : {&x, &y, &u, &v, &rho}) field->resize(size);
  }
};

struct Flow {
  static constexpr double viscosity = 0.01, sound_speed = 10;
  int side, K, cells, row;  // cells a side, and with a border of K periodic images
  long count, entries = 0;
  double dx, support, h, mass, kernel;
  State sorted, moved;
  Numbers pressure, inverse, ax, ay, rate;
  std::vector<int> start, filled, cell_of;

  Flow(int side, int K) : side(side), K(K), count(long(side) * side), dx(1.0 / side) {
    support = 3 * dx, h = support / 2, mass = dx * dx;
    kernel = 5 * 7 / (4 * M_PI * h * h) / (h * h);
    cells = int(K / support * (1 - 1e-12)), row = cells + 2 * K;
    const size_t room = size_t(count * std::pow(1 + 2.0 * K / cells, 2) * 1.1) + 4096;
    sorted.resize(room), moved.resize(room);
    for (auto field : {&pressure, &inverse, &ax, &ay, &rate}) field->resize(room);
    start.resize(row * row + 1), filled.resize(row * row), cell_of.resize(count);
    srand48(1234);
    for (long i = 0; i < count; i++) {
      const double x = (i % side + 0.5 + 0.4 * (drand48() - 0.5)) * dx, y = (i / side + 0.5 + 0.4 * (drand48() - 0.5)) * dx;
      moved.x[i] = x, moved.y[i] = y;
      moved.u[i] = -cos(2 * M_PI * x) * sin(2 * M_PI * y), moved.v[i] = sin(2 * M_PI * x) * cos(2 * M_PI * y);
      moved.rho[i] = 1 + 0.005 * (-cos(4 * M_PI * x) - cos(4 * M_PI * y));
    }
    sort();
  }

  int inside(int c) const { return (c - K + cells) % cells + K; }  // the cell that a border cell is an image of

  // From `moved`, by counting, into `sorted`; then the border.
  void sort() {
    std::fill(filled.begin(), filled.end(), 0);
    for (long i = 0; i < count; i++) {
      const int cx = std::clamp(int(moved.x[i] * cells), 0, cells - 1), cy = std::clamp(int(moved.y[i] * cells), 0, cells - 1);
      cell_of[i] = (cy + K) * row + cx + K;
      filled[cell_of[i]]++;
    }
    int first = 0;
    for (int cy = 0; cy < row; cy++)
      for (int cx = 0; cx < row; cx++) {
        start[cy * row + cx] = first;
        first += filled[inside(cy) * row + inside(cx)];
      }
    start[row * row] = first, entries = first;
    for (int c = 0; c < row * row; c++) filled[c] = start[c];
    for (long i = 0; i < count; i++) {
      const int place = filled[cell_of[i]]++;
      sorted.x[place] = moved.x[i], sorted.y[place] = moved.y[i], sorted.rho[place] = moved.rho[i];
      sorted.u[place] = moved.u[i], sorted.v[place] = moved.v[i];
    }
    for (int cy = 0; cy < row; cy++)
      for (int cx = 0; cx < row; cx++) {
        const int own = cy * row + cx, from = inside(cy) * row + inside(cx);
        if (own == from) continue;
        const double shift_x = cx < K ? -1 : cx >= K + cells ? 1 : 0, shift_y = cy < K ? -1 : cy >= K + cells ? 1 : 0;
        for (int k = 0; k < start[own + 1] - start[own]; k++) {
          const int a = start[own] + k, b = start[from] + k;
          sorted.x[a] = sorted.x[b] + shift_x, sorted.y[a] = sorted.y[b] + shift_y, sorted.rho[a] = sorted.rho[b];
          sorted.u[a] = sorted.u[b], sorted.v[a] = sorted.v[b];
        }
      }
    for (long i = entries; i < entries + 64; i++) sorted.x[i] = sorted.y[i] = 1e9, sorted.rho[i] = 1;  // spare lanes
  }

  void rates() {
    for (long i = 0; i < entries + 32; i++) {
      inverse[i] = 1 / sorted.rho[i];
      pressure[i] = sound_speed * sound_speed * (sorted.rho[i] - 1) * inverse[i] * inverse[i];
      ax[i] = ay[i] = rate[i] = 0;
    }
    const double *X = sorted.x.data(), *Y = sorted.y.data(), *U = sorted.u.data(), *V = sorted.v.data();
    const double *P = pressure.data(), *Q = inverse.data();
    double *AX = ax.data(), *AY = ay.data(), *R = rate.data();
    const Lanes one = _mm256_set1_pd(1), zero = _mm256_setzero_pd(), per = _mm256_set1_pd(1 / support);
    const Lanes eta2 = _mm256_set1_pd(0.01 * h * h);
    for (int cy = 0; cy < row - K; cy++)
      for (int cx = 0; cx < row; cx++)
        for (int i = start[cy * row + cx]; i < start[cy * row + cx + 1]; i++) {
          const Lanes x = _mm256_set1_pd(X[i]), y = _mm256_set1_pd(Y[i]), u = _mm256_set1_pd(U[i]), v = _mm256_set1_pd(V[i]);
          const Lanes p = _mm256_set1_pd(P[i]), factor = _mm256_set1_pd(2 * viscosity * Q[i]);
          Lanes sx = zero, sy = zero, sr = zero;
          for (int step = 0; step <= K && cy + step < row; step++) {
            const int *cell = &start[(cy + step) * row];
            const int begin = step ? cell[std::max(cx - K, 0)] : i + 1, end = cell[std::min(cx + K, row - 1) + 1];
            for (int j = begin; j < end; j += 4) {
              const Lanes dx = x - _mm256_loadu_pd(X + j), dy = y - _mm256_loadu_pd(Y + j), r2 = dx * dx + dy * dy;
              const Lanes q = _mm256_max_pd(one - _mm256_sqrt_pd(r2) * per, zero), F = q * q * q;
              const Lanes du = u - _mm256_loadu_pd(U + j), dv = v - _mm256_loadu_pd(V + j);
              const Lanes drag = factor * _mm256_loadu_pd(Q + j) * (r2 / (r2 + eta2)), push = p + _mm256_loadu_pd(P + j);
              const Lanes fx = F * (drag * du - push * dx), fy = F * (drag * dv - push * dy), fr = F * (du * dx + dv * dy);
              sx += fx, sy += fy, sr += fr;
              _mm256_storeu_pd(AX + j, _mm256_loadu_pd(AX + j) - fx);
              _mm256_storeu_pd(AY + j, _mm256_loadu_pd(AY + j) - fy);
              _mm256_storeu_pd(R + j, _mm256_loadu_pd(R + j) + fr);
            }
          }
          AX[i] += total(sx), AY[i] += total(sy), R[i] += total(sr);
        }
  }

  void step(double dt) {
    rates();
    const double factor = -mass * kernel * dt;
    long k = 0;
    for (int cy = K; cy < K + cells; cy++)
      for (int i = start[cy * row + K]; i < start[cy * row + K + cells]; i++, k++) {
        moved.u[k] = sorted.u[i] + factor * ax[i], moved.v[k] = sorted.v[i] + factor * ay[i];
        moved.rho[k] = sorted.rho[i] + factor * rate[i];
        const double x = sorted.x[i] + dt * moved.u[k], y = sorted.y[i] + dt * moved.v[k];
        moved.x[k] = x - std::floor(x), moved.y[k] = y - std::floor(y);
      }
    sort();
  }

  double energy() const {
    double sum = 0;
    for (long i = 0; i < count; i++) sum += moved.u[i] * moved.u[i] + moved.v[i] * moved.v[i];
    return sum / 2 * mass;
  }
};

int main(int, char **arguments) {
  const int side = atoi(arguments[1]), steps = atoi(arguments[2]);
  for (int K = 1; K <= 3; K++) {
    Flow flow(side, K);
    const double dt = 0.25 * flow.h / (Flow::sound_speed + 1), before = flow.energy();
    double least = 1e9;
    for (int k = 0; k < steps; k++) {
      const auto begin = std::chrono::steady_clock::now();
      flow.step(dt);
      least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    printf("%d %.9g %.9g\n", K, least, flow.energy() / before);
  }
}
