// The four random words of compile/loops/random.hpp for a counter and a key of zeros, and for one of ones.
#include <stdio.h>

#include <initializer_list>

#include "random.hpp"

extern "C" const int64_t FUSES = 0;

int main() {
    for (uint64_t every : {uint64_t(0), uint64_t(0xFFFFFFFF)}) {
        const U all = U{} + every;
        Philox words{{all, all, all, all}};
        words.mix(all, all);
        for (int64_t lane = 0; lane < W; lane++, printf("\n"))
            for (const U &word : words.word) printf("%.0f ", double(word[lane]));
    }
    return 0;
}
