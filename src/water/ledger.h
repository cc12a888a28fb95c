#pragma once
// Where the water of a fruit is: what was lost, what is left, and the solids that stay.

namespace windfall::water {

/// Water lost + water left + solids = the start mass, to rounding, after any number of losses.
class WaterLedger {
  public:
    /// `start_mass_kg`: of the fresh fruit; `water_kg`: the part that is water. Throws InputError unless
    /// 0 < water_kg <= start_mass_kg.
    WaterLedger(double start_mass_kg, double water_kg);

    /// Takes up to `amount_kg` (>= 0; there is never less than no water left); returns what was taken.
    double take(double amount_kg);

    double start_mass_kg() const { return m_start; }
    double start_water_kg() const { return m_start_water; }
    double solids_kg() const { return m_solids; }
    double lost_kg() const { return m_lost; }
    double water_left_kg() const { return m_left; }
    double mass_kg() const { return m_left + m_solids; }
    /// Lost water over the water at the start, 0..1.
    double lost_fraction() const { return m_lost / m_start_water; }
    /// (lost + left + solids - start) / start: zero but for rounding.
    double error() const { return ((m_lost + m_left) + m_solids - m_start) / m_start; }

    /// Puts back the two accounts of a ledger with the same start, as a checkpoint kept them. Throws
    /// InputError when they do not add up to the water at the start.
    void restore(double lost_kg, double water_left_kg);

  private:
    double m_start, m_start_water, m_solids;
    double m_lost = 0;
    double m_left;
};

}  // namespace windfall::water
