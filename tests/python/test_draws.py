"""Draws from the posterior: the numbers of the file, pandas, xarray, ArviZ."""

import shutil
import sys
import types
import warnings

import numpy as np
import pytest

import myoid

FORCE, LENGTH = "BIC.max_isometric_force", "BIC.optimal_fiber_length"


@pytest.fixture(scope="module")
def drawn(recording, tmp_path_factory):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", myoid.MyoidWarning)
        return myoid.run(recording, out=tmp_path_factory.mktemp("posterior") / "r")


def test_draws_are_the_numbers_of_the_file_to_the_bit(drawn):
    # NumPy's own reader of text is the other reader.
    file = drawn.path / "posterior.csv"
    table = np.genfromtxt(file, delimiter=",", skip_header=1)
    draws = drawn.draws
    assert draws.values.shape == (len(table), len(draws.names)) and len(draws) == 1000
    assert draws.values.tobytes() == np.ascontiguousarray(table[:, 1:]).tobytes()
    assert draws.weights.tobytes() == np.ascontiguousarray(table[:, 0]).tobytes()
    assert ["weight", *draws.names] == file.read_text().splitlines()[0].split(",")
    assert np.array_equal(draws[FORCE], table[:, 1 + draws.names.index(FORCE)]) and FORCE in draws
    assert draws.unit(FORCE) == "N" and draws.unit(LENGTH) == "m" and draws.unit("subject.emg_delay") == "s"
    assert draws.unit("BIC.concentric_curvature") == "1" and "1000 draws" in repr(draws)
    for wrong in (draws.unit, draws.__getitem__):
        with pytest.raises(KeyError, match="there are BIC"):
            wrong("none")


def test_draws_have_the_intervals_of_the_table(drawn):
    # posterior.csv has every fourth draw behind the intervals. The quantile 0.025 of 1,000 draws of a normal
    # distribution has the standard error sqrt(0.025 * 0.975 / 1000) / pdf(1.96) = 0.084 standard deviations, which are a
    # quarter of the interval; the bound is four of them.
    draws = drawn.draws
    for name in (FORCE, LENGTH, "TRI.max_isometric_force"):
        row = drawn.parameter(*name.split("."))
        low, high = np.quantile(draws.equally_weighted()[:, draws.names.index(name)], [0.025, 0.975])
        tolerance = 4 * 0.084 * (row["ci_high"] - row["ci_low"]) / 4
        assert abs(low - row["ci_low"]) < tolerance and abs(high - row["ci_high"]) < tolerance


def test_a_weight_is_how_often_a_draw_stands():
    draws = myoid.Draws(np.array([[1.0], [2.0], [3.0], [4.0]]), ["BIC.max_isometric_force"], ["N"],
                        np.array([0.5, 0.25, 0.25, 0.0]))  # fmt: skip
    assert draws.equally_weighted()[:, 0].tolist() == [1.0, 1.0, 2.0, 3.0]


def test_pandas_and_xarray(drawn):
    draws = drawn.draws
    pytest.importorskip("pandas")
    frame = draws.to_pandas()
    assert np.array_equal(frame.to_numpy(), draws.values) and list(frame.columns) == draws.names
    assert frame.attrs["units"][LENGTH] == "m"
    assert np.array_equal(frame.index.get_level_values("weight"), draws.weights)
    pytest.importorskip("xarray")
    array = draws.to_xarray()
    assert array.dims == ("draw", "parameter") and np.array_equal(array.values, draws.values)
    one = array.sel(parameter=LENGTH)
    assert np.array_equal(one, draws[LENGTH]) and one.unit == "m" and np.array_equal(one.weight, draws.weights)


def test_arviz_gets_a_group_with_one_chain(drawn, monkeypatch):
    pytest.importorskip("xarray")
    # Debian has no ArviZ: a stand-in hands back what it is given. ArviZ 1 has another name of the function.
    for name in ("convert_to_inference_data", "convert_to_datatree"):
        stand_in = types.ModuleType("arviz")
        setattr(stand_in, name, lambda dataset, group: {group: dataset})
        monkeypatch.setitem(sys.modules, "arviz", stand_in)
        posterior = drawn.to_inference_data()["posterior"]
        assert set(posterior.data_vars) == set(drawn.draws.names)
        assert posterior[FORCE].dims == ("chain", "draw") and posterior.sizes == {"chain": 1, "draw": 1000}
        assert posterior[FORCE].attrs["units"] == "N"
        whole = drawn.draws.equally_weighted()
        assert np.array_equal(posterior[LENGTH].values[0], whole[:, drawn.draws.names.index(LENGTH)])


def test_without_arviz_the_error_has_the_remedy(drawn, monkeypatch):
    monkeypatch.setitem(sys.modules, "arviz", None)
    with pytest.raises(ImportError, match="pip install arviz$"):
        drawn.to_inference_data()


def test_a_run_without_draws_says_so(result, tmp_path):
    for file in ("parameters.csv", "parameters.json", "run.json"):
        shutil.copy(result.path / file, tmp_path)
    with pytest.raises(myoid.InvalidInput, match="holds no posterior.csv"):
        myoid.Result(tmp_path).draws  # noqa: B018


@pytest.mark.parametrize("text, line, found", [
    ("weight,BIC.no_such\n1,2\n", 1, "no_such"),
    ("", 1, "expected weight"),
    ("weight,BIC.max_isometric_force\n1,2\n0.5\n", 3, "found 1 cells, expected 2"),
    ("weight,BIC.max_isometric_force\n1,two\n", 2, "two"),
])  # fmt: skip
def test_a_damaged_file_is_named_with_its_line(tmp_path, text, line, found):
    (tmp_path / "posterior.csv").write_text(text)
    with pytest.raises(myoid.ReadError, match=found) as error:
        myoid.Draws.read(tmp_path / "posterior.csv", {"max_isometric_force": "N"})
    assert error.value.line == line and error.value.path.endswith("posterior.csv")
