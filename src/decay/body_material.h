#pragma once
// From firmness and thickness to moduli and lengths; from water loss and rot to the material of each element.
#include <span>
#include <vector>

#include "decay/body.h"
#include "decay/tetrahedra.h"

namespace windfall::decay {

/// Throws InputError naming the setting that is out of range.
void check_settings(const BodySettings& settings);
/// Throws InputError; `skin_vertices`: the length that rot must have, if any.
void check_load(const BodyLoad& load, std::size_t skin_vertices);

/// Young's modulus of the fresh flesh (Pa): 2 kPa * 2000^(firmness / 100); tomato (50) 89 kPa, apple (80)
/// 0.87 MPa.
double fresh_modulus_pa(double firmness);

/// 0.05 mm + 3 mm (thickness / 100)^2: tomato (20) 0.17 mm, apple (30) 0.32 mm, orange (60) 1.13 mm.
double skin_thickness_of(double thickness);

/// Modulus and length ratio of every element under a load.
class FleshMaterial {
  public:
    FleshMaterial(const FleshMesh& mesh, const BodySettings& settings, double density_kg_m3);

    /// `rot`: per surface node 0..1; `mass_ratio`: share of the fresh mass that is left.
    void apply(const BodyLoad& load, const std::vector<float>& rot, double mass_ratio);

    const std::vector<double>& modulus_pa() const { return m_modulus; }
    const std::vector<double>& theta() const { return m_theta; }

  private:
    struct RotSource {
        std::array<std::int32_t, 4> column{};  ///< of the four vertices; the first one's again for the centre
        float reach = 0;                       ///< exp(-(depth / rot depth)^2)
    };
    BodySettings m_settings;
    double m_least_modulus_pa;
    std::vector<RotSource> m_rot;
    std::vector<double> m_modulus, m_theta;
};

}  // namespace windfall::decay
