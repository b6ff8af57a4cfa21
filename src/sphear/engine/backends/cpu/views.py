"""Arrays at addresses, as compiled stages see them, and calls of stages at theirs.

A stage is given numbers only: the addresses of its arrays and how many rows they have. So all stages have one
signature, each is compiled by itself, and flows that share a stage share its machine code.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numba.np.arrayobj import populate_array

_INTEGER = ir.IntType(64)
_ADDRESSES = types.Array(types.int64, 1, "C")

# status = stage(addresses of its arrays, sizes)
SIGNATURE = types.int64(_ADDRESSES, _ADDRESSES)


def _view(dtype: Any, dimensions: int) -> Any:
    """A compiled function (address, rows[, columns]) -> the array of this type that stands there."""
    kind = types.Array(dtype, dimensions, "C")

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        address, *shape = args
        item = context.get_data_type(dtype)
        strides = [ir.Constant(_INTEGER, context.get_abi_sizeof(item))]
        for extent in reversed(shape[1:]):
            strides.insert(0, builder.mul(strides[0], extent))
        array = context.make_array(kind)(context, builder)
        data = builder.inttoptr(address, item.as_pointer())
        populate_array(array, data=data, shape=shape, strides=strides, itemsize=strides[-1], meminfo=None)
        return array._getvalue()

    def one(typingctx, address, rows):  # type: ignore[no-untyped-def]
        return kind(types.int64, types.int64), codegen

    def two(typingctx, address, rows, columns):  # type: ignore[no-untyped-def]
        return kind(types.int64, types.int64, types.int64), codegen

    return intrinsic(one if dimensions == 1 else two)


floats, float_table = _view(types.float64, 1), _view(types.float64, 2)
integers, integer_table = _view(types.int64, 1), _view(types.int64, 2)
short_integers, short_integer_table = _view(types.int32, 1), _view(types.int32, 2)
octets, octet_table = _view(types.uint8, 1), _view(types.uint8, 2)


@intrinsic
def call(typingctx, stage, addresses, sizes):  # type: ignore[no-untyped-def]
    """The status of the stage at an address; its exceptions are passed on."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        convention = context.call_conv
        function = convention.get_function_type(SIGNATURE.return_type, SIGNATURE.args).as_pointer()
        status, result = convention.call_function(
            builder, builder.inttoptr(args[0], function), SIGNATURE.return_type, SIGNATURE.args, args[1:]
        )
        with cgutils.if_unlikely(builder, status.is_error):
            convention.return_status_propagate(builder, status)
        return result

    return types.int64(types.int64, _ADDRESSES, _ADDRESSES), codegen


def address_of(stage: Any) -> int:
    """The address of a compiled stage, which must be kept alive while it is called."""
    stage.compile(SIGNATURE.args)
    compiled = stage.overloads[SIGNATURE.args]
    return int(compiled.library.get_pointer_to_function(compiled.fndesc.llvm_func_name))
