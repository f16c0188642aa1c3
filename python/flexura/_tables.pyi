"""The tables of the model file as methods. Written by `python/tables.py` from the schema."""

from typing import Any

from ._references import Handle

# A number (SI), a text with a unit, a quantity of pint, or a formula.
Number = Any

class Tables:
    def parameter(self, name: Any, value: Number, /) -> Handle:
        """Named numbers that expressions may use; they may refer to each other in any order, and be overridden by
            `--set`."""
    def material(
        self,
        name: str,
        /,
        *,
        library: Any = ...,
        young: Number = ...,
        shear: Number = ...,
        poisson: Number = ...,
        density: Number = ...,
        yield_strength: Number = ...,
        repeat: Any = ...,
        **keys: Any,
    ) -> Handle:
        """A linear elastic material: isotropic with `poisson`; with `shear`, E and G stand for themselves, as along
            the fibres of a composite.

        library: A material that `flexura materials` lists; what stands beside it takes the place of its numbers.
        young: Young's modulus; needed without `library`.
        shear: Shear modulus.
        poisson: Poisson's ratio, above -1 and at most 0.5.
        density: Density.
        yield_strength: Yield strength; enables the safety factor.
        repeat: Makes a table for every combination of the indices; `{i}` in the name and in texts becomes a number.
        """
    def section(
        self,
        name: str,
        /,
        *,
        shape: Any = ...,
        plane_strain: Any = ...,
        along: Any = ...,
        width: Any = ...,
        height: Any = ...,
        repeat: Any = ...,
        diameter: Any = ...,
        outer_diameter: Number = ...,
        inner_diameter: Number = ...,
        EA: Any = ...,
        GJ: Any = ...,
        EI2: Any = ...,
        EI3: Any = ...,
        GA2: Any = ...,
        GA3: Any = ...,
        matrix: Any = ...,
        mass_per_length: Number = ...,
        rotary_inertia: Any = ...,
        **keys: Any,
    ) -> Handle:
        """A cross section: e2 runs along the width, e3 along the height. Every dimension may be an expression of
            the arc length s.

        shape: What kind it is.
        plane_strain: The strip is too wide to contract sideways: bending stiffness E/(1 - poisson^2).
        along: Dimensions that vary along the beam, straight lines between the rows.
        width: Along e2.
        height: Along e3.
        repeat: Makes a table for every combination of the indices; `{i}` in the name and in texts becomes a number.
        diameter: Diameter.
        outer_diameter: Outer diameter.
        inner_diameter: Inner diameter.
        EA: Axial stiffness; beams with `extension = false` need none.
        GJ: Torsional stiffness.
        EI2: Stiffness of bending about e2.
        EI3: Stiffness of bending about e3.
        GA2: Shear stiffness along e2, shear factor included.
        GA3: Shear stiffness along e3, shear factor included.
        matrix: The full symmetric stiffness, from (stretch, shear 2, shear 3, twist, bending 2, bending 3) to (F1,
            F2, F3, M1, M2, M3), instead of the keys above.
        mass_per_length: Mass per length.
        rotary_inertia: Moments of inertia per length about e1, e2 and e3.
        """
    def beam(
        self,
        name: str,
        /,
        *,
        material: Any = ...,
        section: Any = ...,
        length: Number = ...,
        curve: Any = ...,
        frame: Any = ...,
        start: Any = ...,
        end: Any = ...,
        shear: Any = ...,
        extension: Any = ...,
        damping: Number = ...,
        added_mass: Number = ...,
        distributed: Any = ...,
        foundation: Any = ...,
        repeat: Any = ...,
        **keys: Any,
    ) -> Handle:
        """A flexible beam. Give `length` (straight along the x axis of its start frame) or `curve`.

        material: Its material; only a section given as a stiffness needs none.
        section: Its cross section.
        length: Length of a straight beam.
        curve: The stress-free shape.
        frame: How the section's axes run along the curve.
        start: Where s = 0 is held; without it the start is free.
        end: Where s = L is held; without it the end is free.
        shear: Sections may shear against the axis.
        extension: The axis may stretch.
        damping: Time τ of a damping within the material: forces and moments are those of the strains plus τ times
            their rates.
        added_mass: Mass per undeformed length that moves with the beam besides its section's and does not weigh, as
            of a fluid around it.
        distributed: Loads per undeformed length.
        foundation: Elastic foundations: forces per undeformed length that grow with the displacement.
        repeat: Makes a table for every combination of the indices; `{i}` in the name and in texts becomes a number.
        """
    def body(
        self,
        name: str,
        /,
        *,
        at: Any = ...,
        rotation: Any = ...,
        mass: Number = ...,
        center_of_mass: Any = ...,
        inertia: Any = ...,
        repeat: Any = ...,
        **keys: Any,
    ) -> Handle:
        """A rigid body in its initial pose.

        at: Initial position.
        rotation: Initial orientation.
        mass: Mass.
        center_of_mass: Centre of mass in the body's axes.
        inertia: About the centre of mass in the body's axes; used by motion and modes.
        repeat: Makes a table for every combination of the indices; `{i}` in the name and in texts becomes a number.
        """
    def joint(
        self,
        name: str,
        /,
        *,
        kind: Any = ...,
        parent: Any = ...,
        child: Any = ...,
        repeat: Any = ...,
        axis: Any = ...,
        coordinate: Number = ...,
        effort: Number = ...,
        stiffness: Number = ...,
        rest: Number = ...,
        damping: Number = ...,
        limits: Any = ...,
        angle: Any = ...,
        position: Any = ...,
        second_axis: Any = ...,
        first: Any = ...,
        second: Any = ...,
        x_axis: Any = ...,
        x: Any = ...,
        y: Any = ...,
        z: Any = ...,
        rotation: Any = ...,
        child_curve: Any = ...,
        parent_curve: Any = ...,
        concave: Any = ...,
        start: Any = ...,
        by: Any = ...,
        arc: Any = ...,
        slide: Any = ...,
        close: Any = ...,
        child_surface: Any = ...,
        parent_surface: Any = ...,
        motion: Any = ...,
        about: Any = ...,
        range: Any = ...,
        **keys: Any,
    ) -> Handle:
        """A joint between a parent, which carries the fixed frame, and a child, which carries the moving frame. A
            child without a place on it starts at coordinate zero. Drive a coordinate by `coordinate` or load it by
            `effort`, not both. A joint of several coordinates has a table for each, which bears its name.

        kind: What kind it is.
        parent: Carries the fixed frame; at its origin unless placed.
        child: Carries the moving frame; where the fixed frame is initially unless placed.
        repeat: Makes a table for every combination of the indices; `{i}` in the name and in texts becomes a number.
        axis: The axis, in the fixed frame; need not be of unit length.
        coordinate: Drives it to this angle.
        effort: Loads it by this moment on the child.
        stiffness: A spring on the angle.
        rest: Where the spring is relaxed.
        damping: Moment against its angular velocity.
        limits: The range of the angle.
        angle: Turning about the axis.
        position: Sliding along the axis.
        second_axis: The axis that the first turning carries along, as it stands at zero; at right angles to the
            first.
        first: Turning about the first axis.
        second: Turning about the second axis.
        x_axis: The direction of x, at right angles to the normal.
        x: Sliding along x.
        y: Sliding along y, which is the normal times x.
        z: Along the fixed frame's z.
        rotation: The rotation vector from the fixed to the moving frame.
        child_curve: The moving boundary, in the child's frame.
        parent_curve: The fixed boundary, in the parent's frame.
        concave: The child lies within the parent's curve and touches it from there.
        start: Where they touch at coordinate zero: the parameter of the child's curve, then that of the parent's.
        by: What the coordinate is.
        arc: With `by = "arc"`: what drives, loads or springs the arc.
        slide: How the child slides as it rolls.
        close: Bodies that do not touch in the initial poses are brought together.
        child_surface: The moving surface, in the child's frame.
        parent_surface: The fixed surface, in the parent's frame.
        motion: How the child moves on the parent.
        about: Of a rolling motion: the axis, in the fixed frame.
        range: Of a rolling motion: least and greatest angle.
        """
    def coupling(
        self,
        name: str,
        /,
        *,
        relation: Any = ...,
        repeat: Any = ...,
        **keys: Any,
    ) -> Handle:
        """A linear relation between joint coordinates, as gears, racks and screws make. It is kept by efforts that
            do no work.

        relation: An equation, linear in the coordinates: `joint.NAME.coordinate`, or by the coordinate's name
            `joint.NAME.angle`, `.position`, `.x`, `.first` and so on.
        repeat: Makes a table for every combination of the indices; `{i}` in the name and in texts becomes a number.
        """
    def spring(
        self,
        name: str,
        /,
        *,
        law: Any = ...,
        from_: Any = ...,
        to: Any = ...,
        rest_length: Number = ...,
        size: Number = ...,
        damping: Number = ...,
        wrap: Any = ...,
        stiffness: Number = ...,
        tension_only: Any = ...,
        repeat: Any = ...,
        area: Number = ...,
        exponent: Number = ...,
        stress: Number = ...,
        form: Any = ...,
        axial_stiffness: Number = ...,
        toe_strain: Number = ...,
        rows: Any = ...,
        **keys: Any,
    ) -> Handle:
        """A spring, ligament or elastic band between two points. ℓ is the length of its course, ℓ0 the rest length,
            ε = (ℓ - ℓ0)/ℓ0 the strain.

        law: What kind it is.
        from: One end.
        to: The other end.
        rest_length: Length from which the stretch counts.
        size: Size of the animal relative to the one that the numbers are of: a given `rest_length` and elongations
            count `size` times, areas and forces its square, stiffnesses (N/m) `size` times.
        damping: Tension against the rate of its length, while it is not slack.
        wrap: What it runs over.
        stiffness: Stiffness.
        tension_only: Carries nothing when it is shorter than its rest length.
        repeat: Makes a table for every combination of the indices; `{i}` in the name and in texts becomes a number.
        area: A0, the area at rest.
        exponent: k1.
        stress: k2.
        form: The law near slack.
        axial_stiffness: K, the force per unit of strain of the straight part; K/ℓ0 is its stiffness in N/m.
        toe_strain: ε_t, the strain at which the straight part begins; twice the ε_l of knee models.
        rows: Elongation from the rest length, and tension.
        """
    def cable(
        self,
        name: str,
        /,
        *,
        tension: Number = ...,
        length: Number = ...,
        route: Any = ...,
        repeat: Any = ...,
        **keys: Any,
    ) -> Handle:
        """A cable (tendon) without friction, weight or stiffness in bending; its tension is the same everywhere.
            Give `tension` or `length`.

        tension: Its tension.
        length: Its length from anchor to anchor; the tension is found.
        route: What it runs through, straight from one to the next; at its first and last point it is anchored.
        repeat: Makes a table for every combination of the indices; `{i}` in the name and in texts becomes a number.
        """
    def tubes(
        self,
        name: str,
        /,
        *,
        base: Any = ...,
        tube: Any = ...,
        force: Any = ...,
        moment: Any = ...,
        repeat: Any = ...,
        **keys: Any,
    ) -> Handle:
        """Concentric tubes: one to four, each inside the next, pre-curved in front, turning and sliding in each
            other without friction. They neither stretch nor shear.

        base: The mouth of their guide, on a body or on the ground; they leave it along the frame's x axis.
        tube: The tubes, the innermost first; it must reach at least as far as any other.
        force: Dead force on the tip of the innermost, global axes.
        moment: Dead moment there, global axes.
        repeat: Makes a table for every combination of the indices; `{i}` in the name and in texts becomes a number.
        """
    def mass(
        self,
        name: str,
        /,
        *,
        beam: Any = ...,
        at: Number = ...,
        mass: Number = ...,
        inertia: Any = ...,
        repeat: Any = ...,
        **keys: Any,
    ) -> Handle:
        """A lumped mass on a beam.

        beam: The beam.
        at: Where along it.
        mass: The mass.
        inertia: About its centre in the axes of the beam's section; used by modes.
        repeat: Makes a table for every combination of the indices; `{i}` in the name and in texts becomes a number.
        """
    def load(
        self,
        name: str,
        /,
        *,
        body: Any = ...,
        beam: Any = ...,
        at: Number = ...,
        force: Any = ...,
        moment: Any = ...,
        frame: Any = ...,
        repeat: Any = ...,
        **keys: Any,
    ) -> Handle:
        """A force and a moment on a body or a beam.

        body: The body.
        beam: The beam.
        at: The point on the body (its origin unless given), or the place along the beam.
        force: Force.
        moment: Moment.
        frame: Dead or follower.
        repeat: Makes a table for every combination of the indices; `{i}` in the name and in texts becomes a number.
        """
    def output(self, name: Any, value: Number, /) -> Handle:
        """What to read off a result."""
    def unknown(
        self,
        name: str,
        /,
        *,
        guess: Number = ...,
        range: Any = ...,
        **keys: Any,
    ) -> Handle:
        """A parameter that is to be found, so that the targets are met.

        guess: Where the search begins; the value in [parameter] unless given.
        range: The range that must not be left.
        """
    def target(self, name: Any, value: Number, /) -> Handle:
        """Wanted values of results; each key is an expression over results as in [output], or over `output.NAME`.
            Numbers, named by expressions over results. Example: target = { "body.slider.position.x" = "140 mm" }"""
    def study(
        self,
        name: str,
        /,
        *,
        kind: Any = ...,
        repeat: Any = ...,
        parameter: Any = ...,
        range: Any = ...,
        start: Number = ...,
        steps: Number = ...,
        most_points: Number = ...,
        branches: Number = ...,
        event: Any = ...,
        stop: Any = ...,
        guesses: Number = ...,
        imperfection: Any = ...,
        critical: Any = ...,
        at: Number = ...,
        count: Number = ...,
        at_rest: Any = ...,
        trapezoid: Any = ...,
        knots: Any = ...,
        value: Number = ...,
        rate: Number = ...,
        from_: Number = ...,
        to: Number = ...,
        duration: Number = ...,
        samples: Number = ...,
        step: Number = ...,
        data: Any = ...,
        unknown: Any = ...,
        per_specimen: Any = ...,
        bounds: Any = ...,
        noise: Any = ...,
        loss: Any = ...,
        intervals: Any = ...,
        confidence: Number = ...,
        reject: Any = ...,
        output: Any = ...,
        of: Any = ...,
        trace: Any = ...,
        vary: Any = ...,
        degree: Number = ...,
        terms: Any = ...,
        constant: Any = ...,
        pieces: Any = ...,
        minimise: Any = ...,
        maximise: Any = ...,
        constraints: Any = ...,
        stable: Any = ...,
        starts: Number = ...,
        seed: Number = ...,
        method: Any = ...,
        pareto: Any = ...,
        tolerance: Number = ...,
        most_iterations: Number = ...,
        **keys: Any,
    ) -> Handle:
        """What is to be done with the mechanism; `flexura run FILE NAME` does it.

        kind: What kind it is.
        repeat: Makes a table for every combination of the indices; `{i}` in the name and in texts becomes a number.
        parameter: The parameter that changes.
        range: Values between which the path is followed; the first may be the larger.
        start: Where the path starts, from rest under the loads of this value; from inside the range it is followed
            both ways.
        steps: About how many points a path has at least that goes straight from one end of the range to the other.
        most_points: Most points of one branch.
        branches: Follow the branches that are met at branch points, and those that they meet: at most so many, 20
            for `true`.
        event: Points to be found: where a result has a value.
        stop: Where a branch ends besides the ends of the range: an event, or a fold, branch point or event by its
            number.
        guesses: Random pushes at both ends of the range by which branches are looked for that hang together with no
            other.
        imperfection: A further way to such branches.
        critical: Follow a fold or branch point as a second parameter changes.
        at: The parameter's value at the equilibrium; without a parameter, the fraction of the load.
        count: How many critical values, those nearest to `at` first.
        at_rest: About the state at rest without any load, in place of the equilibrium.
        trapezoid: From rest to rest: speeding up, a constant speed, slowing down.
        knots: Times and values that the parameter passes on a cubic spline, at rest at both ends.
        value: The parameter as a function of the time t in seconds, from t = 0; with `duration`.
        rate: A constant rate of the parameter; with `to` or `duration`.
        from: Where a constant rate begins.
        to: Where a constant rate ends.
        duration: How long `value` or `rate` last.
        samples: At how many times the mechanism is looked at, both ends included.
        step: In place of `samples`: times are not farther apart than this.
        data: The measurements: a CSV file beside the model, or a table.
        unknown: Parameters to be found, the same for all specimens; their own values are the first guess.
        per_specimen: Parameters to be found for each specimen.
        bounds: Values between which parameters are looked for.
        noise: Standard deviations of measured outputs.
        loss: What a residual costs.
        intervals: What the intervals of the estimates are found by.
        confidence: Probability that an interval holds the true value.
        reject: Leave out specimens that lie outside what the others predict; they are named in any case.
        output: The output that the formula gives, in SI units or in that of the brackets.
        of: What goes into it: parameters or outputs, in SI units or those of the brackets.
        trace: The trace along whose first branch the model is asked.
        vary: In place of a trace, the grid on which it is asked: from, to, and how many values of each parameter.
        degree: All products of powers up to this degree.
        terms: In place of `degree`: its terms, each a product of powers of what goes in, or of absolute values.
        constant: Has a formula that is given by its degree a constant? True or false.
        pieces: In place of `degree` and `terms`: one formula after another along what goes in.
        minimise: What is made least: the name of an output, or a formula over results.
        maximise: What is made greatest.
        constraints: What must hold at the optimum.
        stable: Refuse designs whose equilibrium is unstable.
        starts: From how many designs is searched: the guess, and others that fill the ranges evenly.
        seed: Another seed draws other starts.
        method: How is searched.
        pareto: A second objective: the front of compromises between the two.
        tolerance: How well the conditions of an optimum must hold, relative to the ranges and to what is bounded.
        most_iterations: Most steps of one search.
        """
