"""The processors that kernels are compiled for: this one, and the virtual one of web pages."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import llvmlite
import llvmlite.binding as llvm


@dataclass(frozen=True, kw_only=True)
class Target:
    """A kind of processor.

    Parameters
    ----------
    triple, cpu, features : str
        As LLVM calls them.
    fuses : bool
        Whether an instruction computes a b + c with one rounding.
    estimates_roots : bool
        Whether an instruction estimates 1/√x for eight doubles.
    jit : bool
        Whether its code is run by this process.
    pointer_bits : int
        Size of an address.
    """

    triple: str
    cpu: str
    features: str
    fuses: bool = False
    estimates_roots: bool = False
    jit: bool = False
    pointer_bits: int = 64

    @cached_property
    def machine(self) -> Any:
        """LLVM's code generator."""
        model = {"jit": True, "reloc": "pic"} if self.jit else {"reloc": "static"}
        return llvm.Target.from_triple(self.triple).create_target_machine(
            cpu=self.cpu, features=self.features, opt=2, **model
        )

    @cached_property
    def name(self) -> str:
        """What identifies the target and the LLVM versions, for keys of caches."""
        version = ".".join(map(str, llvm.llvm_version_info))
        return f"{self.triple} {self.cpu} {self.features} llvmlite {llvmlite.__version__} llvm {version}"


@lru_cache(maxsize=1)
def native() -> Target:
    """The processor that runs this process."""
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    features = llvm.get_host_cpu_features()
    return Target(
        triple=llvm.Target.from_default_triple().triple,
        cpu=llvm.get_host_cpu_name(),
        features=features.flatten(),
        fuses=True,
        estimates_roots=bool(features.get("avx512f", False)),
        jit=True,
    )


@lru_cache(maxsize=1)
def wasm32() -> Target:
    """WebAssembly with vectors of two doubles, which browsers have had since 2023."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    return Target(
        triple="wasm32-unknown-unknown", cpu="generic", features="+simd128,+nontrapping-fptoint", pointer_bits=32
    )
