from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ValidationError

from reina.api.http.problems import MAX_FAULTS, ProblemError, problem_of_validation
from reina.protocol.resources import Fault


class Numbers(BaseModel):
    numbers: list[int]


def validation_error(document: Any) -> ValidationError:
    try:
        Numbers.model_validate(document)
    except ValidationError as error:
        return error
    raise AssertionError("it fits")


def test_at_most_twenty_faults_are_told() -> None:
    problem = problem_of_validation(validation_error({"numbers": ["x"] * 5000})).problem
    assert len(problem.errors) == MAX_FAULTS == 20
    assert problem.errors[0].location == "numbers/0"
    assert problem.detail.endswith("and 4980 more")
    assert len(problem.model_dump_json()) < 10_000


def test_few_faults_are_all_told() -> None:
    problem = problem_of_validation(validation_error({"numbers": ["x"] * 20})).problem
    assert len(problem.errors) == 20
    assert "more" not in problem.detail


def test_no_problem_tells_more_than_that() -> None:
    faults = [Fault(detail="wrong", location=str(number)) for number in range(100)]
    assert len(ProblemError(422, "x", "X", "many", errors=faults).problem.errors) == MAX_FAULTS
