// The shape of what pastefit puts into the page as JSON (calibrate/report/page_content.cpp): types only. A unit stands
// at the end of a name. What a folder lacks is left out.

/**
 * @typedef {object} Content
 * @property {string} program that made the page
 * @property {string} command that makes the page again
 * @property {string[]} missing sentences: what the page lacks
 * @property {boolean} under_way
 * @property {string} [title]
 * @property {Verdict} [verdict]
 * @property {Parameter[]} [parameters] without a card the free ones of the study
 * @property {TypeInGroup[]} [type_in]
 * @property {string[]} [damping]
 * @property {number} [interval_level] 0 where intervals were not worked out
 * @property {number} [radius_mm]
 * @property {Test[]} [tests]
 * @property {LawCurve[]} [law]
 * @property {string} [summary]
 * @property {Provenance} [provenance]
 * @property {Inference} [inference]
 * @property {Search} search
 */

/** @typedef {Content & Required<Omit<Content, "inference">>} CardContent content of a folder with a card */

/**
 * @typedef {object} Verdict
 * @property {string} words
 * @property {string[]} reservations
 * @property {boolean} meets_laboratory
 * @property {boolean} [refuted]
 * @property {boolean} [only_heaps_refute] every reading is met, but a laboratory would reject the heaps
 * @property {string} [unconfirmed] why it is not; empty if it is confirmed
 * @property {number} misfit over the one that is asked for
 * @property {boolean} fresh confirmed on packings that the search had not seen
 * @property {number[]} packings
 */

/**
 * @typedef {object} Range of a free parameter
 * @property {number} lower
 * @property {number} upper
 * @property {"log" | "linear"} scale
 */

/** @typedef {{name: string} & Partial<Range> & ParameterValue} Parameter of the material; a free one has a range */

/**
 * @typedef {object} ParameterValue
 * @property {boolean} free
 * @property {string} [meaning]
 * @property {number} [value] left out where nothing was found yet
 * @property {[number, number]} [interval]
 * @property {[boolean, boolean]} [at_bounds] ends of it that are the study's bounds
 * @property {string} [not_identified] why there is no interval
 */

/** @typedef {{quantity: string, value: string, unit: string, remark: string}} TypeInRow */
/** @typedef {{title: string, rows: TypeInRow[]}} TypeInGroup */

/**
 * @typedef {object} Test
 * @property {string} name empty if it is the only one
 * @property {string} kind
 * @property {boolean} hold_out
 * @property {string} source
 * @property {string} notes
 * @property {string} licence
 * @property {boolean} twin
 * @property {string} lab_file
 * @property {string} lab_hash
 * @property {string} conditions lines
 * @property {string} remarks
 * @property {Reading[]} readings
 * @property {Record<string, YieldStress>} [yield_stress] by the names of readings
 * @property {{value: number, standard_deviation: number}} [measured_yield_stress] Pa
 * @property {Drawing[]} drawings
 * @property {FilmIndex} [film] its bytes are the text of the element film-INDEX
 * @property {{packing: number, program: string, same_as_card: boolean} | null} [run_shown]
 */

/**
 * @typedef {object} YieldStress of a fluid that would have a reading [Pa] (calibrate/card/standing.h)
 * @property {string} formula
 * @property {number} simulated
 * @property {number} [measured] by the laboratory's reading
 * @property {number} [ratio] of the simulated to the one that was measured
 * @property {number} [deviations]
 */

/**
 * @typedef {object} Reading of a test; what the laboratory did not take has no more than the simulated numbers
 * @property {string} name
 * @property {number} simulated mean over packings
 * @property {number} simulated_standard_deviation
 * @property {number} [standard_error] of the mean; left out of one packing
 * @property {number[]} packings
 * @property {number} [measured]
 * @property {number} [standard_deviation]
 * @property {number} [repeats]
 * @property {number} [weight]
 * @property {number} [tolerance]
 */

/** @typedef {Reading & Required<Omit<Reading, "standard_error">>} MeasuredReading */
/** @typedef {[number, number]} Point */
/** @typedef {"laboratory" | "simulation" | "apparatus" | "run" | "rejected"} DrawnBy */

/**
 * @typedef {object} Drawing of a test (calibrate/laboratory/drawing.h)
 * @property {string} name
 * @property {string} x
 * @property {string} y
 * @property {boolean} to_scale
 * @property {{name: string, points: [number, number, number][]}[]} bands
 * @property {Line[]} lines
 * @property {Length[]} lengths
 */

/**
 * @typedef {object} Line
 * @property {string} name
 * @property {DrawnBy} by
 * @property {Point[]} points
 * @property {number} deviation
 * @property {number} [packing] of the line of one run
 */

/**
 * @typedef {object} Length
 * @property {string} reading
 * @property {DrawnBy} by
 * @property {Point} from where its line stands
 * @property {Point} to
 * @property {Point} first what it is the distance of
 * @property {Point} last
 * @property {number} value
 * @property {number} deviation
 */

/**
 * @typedef {object} FilmIndex what is known of a film before its bytes are read (calibrate/report/run_recording.h)
 * @property {number} quantum_m
 * @property {[number, number, number]} low_m
 * @property {number} most_pull_n
 * @property {PartIndex[]} reels
 */

/** @typedef {{grains: number, frames: {time_s: number, phase: string, walls?: Wall[]}[]}} PartIndex */
/** @typedef {Plane | Plate | Shell | Ribs} Wall */
/** @typedef {[number, number, number]} Vector */
/** @typedef {{shape: "plane", name: string, point_m: Vector, normal: Vector}} Plane */
/** @typedef {{shape: "plate", name: string, centre_m: Vector, along: Vector, across: Vector, half_m: Point}} Plate */
/** @typedef {{shape: "shell", name: string, base_m: Vector, radii_m: Point, height_m: number}} Shell */
/** @typedef {{shape: "ribs", name: string, base_m: Vector, thickness_m: number} & RibRow} Ribs */
/** @typedef {{height_m: number, pitch_m: number}} RibRow */

/** @typedef {{name: string, role: "fitted" | "equivalent" | "other", points: Point[]}} LawCurve micrometres, mN */
/** @typedef {{study_file: string, study_hash: string, program: string}} Provenance */

/**
 * @typedef {object} Inference
 * @property {string} words
 * @property {number} simulations
 * @property {Record<string, number>} [noise] of a fitted reading, from packing to packing
 * @property {EquivalentMaterial[]} [family] the first is the recommended one
 * @property {Sensitivity[] | null} [sensitivities]
 */

/**
 * @typedef {object} Sensitivity of the readings to one parameter, the others as recommended
 * @property {string} parameter
 * @property {number} from
 * @property {number} to
 * @property {Record<string, [change: number, deviation: number]>} changes
 */

/**
 * @typedef {object} EquivalentMaterial
 * @property {Record<string, number>} values
 * @property {Record<string, number>} readings
 * @property {boolean} simulated
 */

/**
 * @typedef {object} Search
 * @property {string} program
 * @property {number} wall_s
 * @property {Record<string, number>} measured readings of all tests
 * @property {Record<string, Length[]>} laboratory by test, of its last drawing that has them: the lengths measured
 * @property {string} [error_unit]
 * @property {number} [misfit_asked]
 * @property {string} [strategy]
 * @property {string} [reason]
 * @property {number} [budget]
 * @property {number} [seed]
 * @property {Simulation[]} history
 * @property {MisfitMap | null} map
 */

/**
 * @typedef {object} Simulation
 * @property {number} number
 * @property {number} packing
 * @property {string} [test]
 * @property {Record<string, number>} values
 * @property {Record<string, number>} readings
 * @property {string} [failure]
 * @property {boolean} [ended_early]
 * @property {boolean} [other_grains]
 * @property {boolean} [confirmation]
 * @property {number} [misfit]
 * @property {Sketch} [sketch]
 */

/** @typedef {{heap: boolean, points: Point[]}} Sketch a heap from the side, or the curve of a test */

/**
 * @typedef {object} MisfitMap
 * @property {MapAxis} x
 * @property {MapAxis} y
 * @property {number[]} miss row by row
 * @property {Point[]} equivalent the first is the recommended one
 * @property {Point[]} simulated
 */

/** @typedef {{name: string, places: number[]} & Range} MapAxis */

export {};
