#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "saca/lab/tune/fit_log.h"

namespace saca::tune {

/// What a fit found of one parameter, in the unit of its key in data/vehicles (all are SI).
struct FittedParameter {
  std::string_view section;  ///< table of the car's file; "road" for the grip
  std::string_view key;
  double base = 0.0;
  double value = 0.0;  ///< the base's where not determined; six digits, as it is written
  double low = 0.0;    ///< 95 % interval; the base where not determined
  double high = 0.0;
  bool determined = false;  ///< the logs say much more than the base's uncertainty
};

/// How well the fitted model predicts one signal of one log, in the unit of its column.
struct SignalQuality {
  std::string log;  ///< its name
  Signal signal = Signal::speed;
  double noise = 0.0;   ///< sd between neighbouring rows: what no model can predict
  double rms = 0.0;     ///< of the residual, outliers left out
  double offset = 0.0;  ///< the sensor's constant error
  double run = 1.0;     ///< how many rows in a sequence err alike: 1 for white noise
  std::size_t num_outliers = 0;
};

struct VehicleFit {
  vehicle::Vehicle car;                     ///< the base with the parameters that are determined
  std::vector<FittedParameter> parameters;  ///< the grip of the road first
  std::vector<SignalQuality> signals;
  double condition = 1.0;  ///< of the correlation matrix of what is determined; 1 is best
  std::vector<std::string> warnings;  ///< why not to trust it, in words
};

/// Fits a car's parameters, and the grip of the road, to tests driven on one road.
///
/// @param base  mass, arms, track, height, wheels, limits stay as they are
/// @param grip  of the road as far as known beforehand [-], in [0.1, 1.2]
/// @param logs  from `read_log`, at least one
///
/// Weighted least squares (Levenberg-Marquardt) of `response` against what was measured, large
/// residuals bent to straight lines (Huber). Each parameter is known beforehand by its base value
/// and a wide normal distribution; one that the logs do not narrow to 0.3 of that stays at its base
/// value. Intervals hold whatever those are, inside their distribution. Weights come from the
/// residuals: their spread and how long they err alike. Also estimated, for each log: the speed at
/// the first row and the sensors' offsets.
///
/// Sources: J. J. More, The Levenberg-Marquardt algorithm: implementation and theory, 1978 (as in
/// Eigen); R. V. Jategaonkar, Flight Vehicle System Identification, 2nd ed., 2015, ch. 4
/// (output-error method, coloured residuals).
[[nodiscard]] VehicleFit fit_vehicle(const vehicle::Vehicle& base, double grip,
                                     const std::vector<Log>& logs);

}  // namespace saca::tune
